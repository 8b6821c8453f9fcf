import {useCallback, useEffect, useLayoutEffect, useMemo, useRef, useState} from "preact/hooks";
import {api, ServerGone} from "./api";
import {download} from "./download";
import {Fits, type Fit} from "./fits";
import {Following} from "./following";
import {MeasuredFiles, opened, type OpenFile} from "./measured";
import {Parameters, type Change} from "./parameters";
import {
    begun, changed, configurationOf, defaultsOf, fragmentOf, inWordsNotLoaded, modelFrom, notLoaded, redone, undone, withMeasured, type History,
} from "./state";
import type {Simulation, Vocabulary} from "./types";
import {Swatch, Views} from "./views";

export function App({vocabulary}: {vocabulary: Vocabulary}) {
    const defaults = useMemo(() => defaultsOf(vocabulary), [vocabulary]);
    const linked = useMemo(() => modelFrom(location.hash, defaults), [defaults]);
    const [history, setHistory] = useState<History>(() => begun(linked.model));
    const [simulation, setSimulation] = useState<Simulation>();
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
    const simulating = useMemo(() => new Following(api.simulate, (answer) => {
        setGone(false);
        setTrouble("");
        setSimulation(answer);
    }, telling(setTrouble)), []);
    const moved = useRef<number>();
    const loaded = useRef(sources);
    loaded.current = sources;
    const change: Change = useCallback((next, settles = true, event) => {
        moved.current = event?.type === "input" ? event.timeStamp : undefined;
        setHistory((all) => changed(all, next, settles));
    }, []);

    useLayoutEffect(() => simulating.want(model, moved.current), [model]);
    useEffect(() => {
        if (history.isMoving) return;
        const fragment = withMeasured(fragmentOf(model, defaults), [...sources, ...named]);
        window.history.replaceState(null, "", fragment ? `#${fragment}` : location.pathname + location.search);
    }, [history, files, named]);
    useEffect(() => setNamed((all) => notLoaded(withMeasured("", all), sources)), [files]);
    useEffect(() => {
        const onLink = () => {
            const {model: next, complaints} = modelFrom(location.hash, defaults);
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
        const again = setInterval(() => simulating.want(model), 3000);
        return () => clearInterval(again);
    }, [isGone, model]);

    const exported = async (form: "csv" | "json" | "configuration") => {
        try {
            const found = (await api.exported(configurationOf(model)))[form];
            const name = {csv: "simulation.csv", json: "simulation.json", configuration: "configuration.json"}[form];
            download(name, typeof found === "string" ? found : JSON.stringify(found, null, 2) + "\n");
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
                            <input type="radio" name="edition" value={edition} checked={model.settings["edition"] === edition}
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
            {trouble && <p class="banner problem" role="alert">{trouble}; the curve is that of before</p>}
            {problem && (
                <p class="banner problem" role="alert">{problem} <button type="button" onClick={() => setProblem("")}>Dismiss</button></p>
            )}
            {named.length > 0 && (
                <p class="banner problem" role="alert">{inWordsNotLoaded(named)} <button type="button" onClick={() => setNamed([])}>Do without</button></p>
            )}
            <p class="hidden" role="status" aria-live="polite">{news}</p>
            <main>
                <div class="sight">
                    {simulation
                        ? <>
                            <Views vocabulary={vocabulary} model={model} simulation={simulation} files={files} fits={fits}
                                onDrawn={() => simulating.drawn()} onError={onError} />
                            <Swatch colour={simulation.colour} />
                        </>
                        : <p class="hint">Computing …</p>}
                </div>
                <Parameters vocabulary={vocabulary} defaults={defaults} model={model} change={change} />
                <div class="work">
                    <MeasuredFiles files={files} setFiles={setFiles} say={setNews} onError={onError} />
                    <Fits vocabulary={vocabulary} defaults={defaults} model={model} change={change} files={files} fits={fits}
                        setFits={setFits} say={setNews} onError={onError} />
                </div>
            </main>
            <footer>skinfit {vocabulary.version}. Research software, not a medical device. Shaded parts of sliders are the ranges published for healthy skin.</footer>
        </>
    );
}
