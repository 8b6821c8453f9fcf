import {useCallback, useEffect, useLayoutEffect, useMemo, useRef, useState} from "preact/hooks";
import {api, ServerGone} from "./api";
import {download} from "./download";
import {drawnFor, questionOf, type Drawn} from "./drawn";
import {Dropping} from "./dropping";
import {Fits, type Fit} from "./fits";
import {Following} from "./following";
import {inWordsRead, MeasuredFiles, opened, sent, type OpenFile} from "./measured";
import {Parameters, type Change} from "./parameters";
import {
    begun, changed, defaultsOf, fragmentOf, inWordsNotLoaded, modelFrom, notLoaded, redone, undone, withMeasured, type History,
} from "./state";
import type {Vocabulary} from "./types";
import {Swatch, Views} from "./views";
import {visible} from "./words";

export function App({vocabulary}: {vocabulary: Vocabulary}) {
    const defaults = useMemo(() => defaultsOf(vocabulary), [vocabulary]);
    const offered = {engine: vocabulary.fit_engines};
    const linked = useMemo(() => modelFrom(location.hash, defaults, offered), [defaults]);
    const [history, setHistory] = useState<History>(() => begun(linked.model));
    const [drawn, setDrawn] = useState<Drawn>();
    const [files, setFiles] = useState<OpenFile[]>(() => (vocabulary.file ? [opened(vocabulary.file)] : []));
    const sources = files.map(({source}) => source);
    const [named, setNamed] = useState(() => notLoaded(location.hash, sources));  // by the link, and not here
    const [fits, setFits] = useState<Fit[]>([]);
    const [problem, setProblem] = useState(linked.complaints.join("; "));
    const [trouble, setTrouble] = useState("");  // what keeps the curve from following the sliders
    const [isGone, setGone] = useState(false);
    const [news, setNews] = useState("");
    const model = history.present;

    const telling = (tell: (message: string) => void) => (error: unknown) => {
        if (error instanceof ServerGone) setGone(true);
        else tell(error instanceof Error ? error.message : String(error));
    };
    const onError = useCallback(telling(setProblem), []);
    const simulating = useMemo(() => new Following(api.simulate, ({models}, question) => {
        setGone(false);
        setTrouble("");
        setDrawn(drawnFor(models, question));
    }, telling(setTrouble)), []);
    const moved = useRef<number>();
    const loaded = useRef(sources);
    loaded.current = sources;
    const change: Change = useCallback((next, settles = true, event) => {
        moved.current = event?.type === "input" ? event.timeStamp : undefined;
        setHistory((all) => changed(all, next, settles));
    }, []);

    const read = useCallback(async (chosen: FileList | null | undefined) => {
        for (const file of Array.from(chosen ?? [])) {
            try {
                const found = await sent(file, vocabulary.largest_file_bytes);
                setFiles((all) => [...all, opened(found)]);
                setNews(inWordsRead(found));
            } catch (error) {
                onError(error);
            }
        }
    }, []);

    useLayoutEffect(() => simulating.want(questionOf(model, files), moved.current), [model, files]);
    useEffect(() => {
        if (history.isMoving) return;
        const fragment = withMeasured(fragmentOf(model, defaults), [...sources, ...named]);
        window.history.replaceState(null, "", fragment ? `#${fragment}` : location.pathname + location.search);
    }, [history, files, named]);
    useEffect(() => setNamed((all) => notLoaded(withMeasured("", all), sources)), [files]);
    useEffect(() => {
        const onLink = () => {
            const {model: next, complaints} = modelFrom(location.hash, defaults, offered);
            setProblem(complaints.join("; "));
            setHistory((all) => changed(all, next));
            setNamed(notLoaded(location.hash, loaded.current));
        };
        const onKey = (event: KeyboardEvent) => {
            const inText = event.target instanceof HTMLInputElement && ["number", "text"].includes(event.target.type);
            if (!(event.ctrlKey || event.metaKey) || inText || event.key.toLowerCase() !== "z") return;
            event.preventDefault();
            setHistory(event.shiftKey ? redone : undone);
        };
        addEventListener("hashchange", onLink);
        addEventListener("keydown", onKey);
        return () => {
            removeEventListener("hashchange", onLink);
            removeEventListener("keydown", onKey);
        };
    }, []);
    useEffect(() => {
        if (!isGone) return;
        const again = setInterval(() => simulating.want(questionOf(model, files)), 3000);
        return () => clearInterval(again);
    }, [isGone, model, files]);

    const exported = async (form: "csv" | "json" | "configuration") => {
        try {
            const {simulations, configuration} = await api.exported(questionOf(model, files));
            const inText = (found: unknown) => (typeof found === "string" ? found : JSON.stringify(found, null, 2) + "\n");
            if (form === "configuration") return download("configuration.json", inText(configuration));
            simulations.forEach((simulation, k) =>
                download(`simulation${simulations.length > 1 ? `_${k + 1}` : ""}.${form}`, inText(simulation[form])));
        } catch (error) {
            onError(error);
        }
    };
    const copyLink = () => navigator.clipboard.writeText(location.href).then(() => setNews("the link is copied"),
        () => setNews("the link is in the address bar"));
    const setEdition = (edition: string) => change({...model, settings: {...model.settings, edition}});

    return (
        <>
            <header>
                <h1>skinfit <span>explore</span></h1>
                <fieldset class="editions">
                    <legend class="hidden">Edition of the model</legend>
                    {(vocabulary.schema.properties["edition"]?.enum ?? []).map(String).map((edition) => (
                        <label title={vocabulary.schema.properties["edition"]?.description}>
                            <input type="radio" name="edition" value={edition} checked={(model.settings["edition"] ?? drawn?.models[0]?.measurement["edition"] ?? vocabulary.configuration["edition"]) === edition}
                                onChange={() => setEdition(edition)} />
                            <span>{edition}</span>
                        </label>
                    ))}
                </fieldset>
                <div class="tools" role="toolbar" aria-label="History and export">
                    <button type="button" disabled={history.past.length === 0} onClick={() => setHistory(undone)}>Undo</button>
                    <button type="button" disabled={history.future.length === 0} onClick={() => setHistory(redone)}>Redo</button>
                    <button type="button" onClick={() => void copyLink()}>Copy link</button>
                    <button type="button" onClick={() => void exported("csv")}>CSV</button>
                    <button type="button" onClick={() => void exported("json")}>JSON</button>
                    <button type="button" onClick={() => void exported("configuration")}>Configuration</button>
                </div>
            </header>
            {isGone && <p class="banner" role="alert">skinfit does not answer: it has ended, or was stopped. Start <code>skinfit explore</code> again
                and open the address it prints; what stands behind the # of this one restores your sliders there.</p>}
            {trouble && <p class="banner problem" role="alert">{visible(trouble)}; the curve is that of before</p>}
            {problem && (
                <p class="banner problem" role="alert">{visible(problem)} <button type="button" onClick={() => setProblem("")}>Dismiss</button></p>
            )}
            {named.length > 0 && (
                <p class="banner problem" role="alert">{inWordsNotLoaded(named)} <button type="button" onClick={() => setNamed([])}>Do without</button></p>
            )}
            <p class="hidden" role="status" aria-live="polite">{visible(news)}</p>
            <main>
                <div class="sight">
                    {drawn
                        ? <>
                            <Views vocabulary={vocabulary} model={model} drawn={drawn} files={files} fits={fits}
                                onDrawn={() => simulating.drawn()} onError={onError} />
                            <Swatch colour={drawn.models[0]!.colour} />
                        </>
                        : <p class="hint">Computing …</p>}
                </div>
                <Parameters vocabulary={vocabulary} defaults={defaults} model={model} measurement={drawn?.models[0]} change={change} />
                <div class="work">
                    <MeasuredFiles names={vocabulary.measurement_settings} files={files} setFiles={setFiles} read={read} say={setNews} onError={onError} />
                    <Fits vocabulary={vocabulary} defaults={defaults} model={model} change={change} files={files} setFiles={setFiles} fits={fits}
                        setFits={setFits} say={setNews} onError={onError} />
                </div>
            </main>
            <Dropping read={read} />
            <footer>skinfit {vocabulary.version}. Research software, not a medical device. Shaded parts of sliders are the ranges published for healthy skin.</footer>
        </>
    );
}
