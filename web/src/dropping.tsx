import {useEffect, useState} from "preact/hooks";

/// Takes files that are dropped anywhere on the page, and says so while they are held above it.
export function Dropping({read}: {read: (chosen: FileList | undefined) => Promise<void>}) {
    const [isOver, setOver] = useState(false);
    useEffect(() => {
        const bringsFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
        const onOver = (event: DragEvent) => {
            if (!bringsFiles(event)) return;
            event.preventDefault();
            setOver(true);
        };
        const onLeave = (event: DragEvent) => { if (event.relatedTarget === null) setOver(false); };
        const onDrop = (event: DragEvent) => {
            setOver(false);
            if (!bringsFiles(event)) return;
            event.preventDefault();
            void read(event.dataTransfer?.files);
        };
        addEventListener("dragover", onOver);
        addEventListener("dragleave", onLeave);
        addEventListener("drop", onDrop);
        return () => {
            removeEventListener("dragover", onOver);
            removeEventListener("dragleave", onLeave);
            removeEventListener("drop", onDrop);
        };
    }, [read]);
    return isOver ? <div class="dropping" role="status">Drop it here to see it beside the model</div> : null;
}
