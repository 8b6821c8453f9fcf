import type {ComponentChildren} from "preact";
import {useLayoutEffect, useRef, useState} from "preact/hooks";

/// What is larger than its place and scrolls in it, with a shadow at the sides where there is more, and words where it
/// scrolls sideways: on a phone nothing else says so.
export function Scrolled({label, children}: {label: string; children: ComponentChildren}) {
    const box = useRef<HTMLDivElement>(null);
    const [more, setMore] = useState("");
    useLayoutEffect(() => {
        const element = box.current!;
        const look = () => {
            const right = element.scrollWidth - element.clientWidth - element.scrollLeft;
            const below = element.scrollHeight - element.clientHeight - element.scrollTop;
            const isMore = {left: element.scrollLeft > 1, right: right > 1, below: below > 1};
            setMore(Object.entries(isMore).filter(([, is]) => is).map(([side]) => side).join(" "));
        };
        look();
        const resized = new ResizeObserver(look);
        resized.observe(element);
        for (const child of Array.from(element.children)) resized.observe(child);
        element.addEventListener("scroll", look, {passive: true});
        return () => {
            resized.disconnect();
            element.removeEventListener("scroll", look);
        };
    }, []);
    const isSideways = more.includes("right") || more.includes("left");
    return (
        <div class="scrolling" data-more={more}>
            {isSideways && <p class="more" aria-hidden="true">{more.includes("right") ? "more to the right: scroll sideways →" : "← more to the left"}</p>}
            <div class="scrolled" tabIndex={0} role="region" aria-label={label} ref={box}>{children}</div>
        </div>
    );
}
