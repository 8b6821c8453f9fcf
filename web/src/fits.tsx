import {useState} from "preact/hooks";
import {api, type Question} from "./api";
import {differencesOf} from "./differences";
import {download} from "./download";
import {showing, shownOf, type OpenFile} from "./measured";
import {Settings, type Change} from "./parameters";
import {counted, inWords, shown, withInterval, withSigma} from "./scale";
import {Scrolled} from "./scrolled";
import {configurationOf, withFitted, type Model} from "./state";
import type {FitState, FittedParameter, Json, Report, TissueEstimate, Vocabulary} from "./types";
import {listed, shortened, visible} from "./words";

/// A fit that runs or has run.
export interface Fit {
    number: number;
    job: string;
    names: string;                          ///< of the spectra
    files: OpenFile[];                      ///< they were ticked in
    measurement: {[setting: string]: Json};  ///< as it was set when the fit began
    state: FitState;
    report?: Report;
}

interface FitsProps {
    vocabulary: Vocabulary;
    defaults: Model;
    model: Model;
    change: Change;
    files: OpenFile[];
    setFiles: (update: (files: OpenFile[]) => OpenFile[]) => void;
    fits: Fit[];
    setFits: (update: (fits: Fit[]) => Fit[]) => void;
    say: (message: string) => void;
    onError: (error: unknown) => void;
}

const fitSettings = ["engine", "uncertainty", "solver", "starts", "noise", "wavelength_min_nm", "wavelength_max_nm"];

/// Of the files that hold a fit's documents; another document has its own name as ending.
const endings: {[form: string]: string} = {report: "json", text: "txt"};

const pause = (milliseconds: number) => new Promise((resolve) => setTimeout(resolve, milliseconds));

const sourceOf = (files: OpenFile[]): string => [...new Set(shownOf(files).map(({file}) => file.source))].join(", ");

/// The spectra that are shown, to be explained together.
const orderOf = (model: Model, files: OpenFile[]): Question => ({
    configuration: configurationOf(model),
    source: sourceOf(files),
    measured: shownOf(files).map(({spectrum}) => spectrum),
});

export function Fits(props: FitsProps) {
    const {vocabulary, model, files, fits, setFits, say, onError} = props;
    const [count, setCount] = useState(0);
    const targets = shownOf(files).map(({spectrum}) => visible(spectrum.name));

    const follow = async (number: number, job: string) => {
        for (;;) {
            const state = await api.fit(job);
            setFits((all) => all.map((fit) =>
                fit.number === number ? {...fit, state, ...(state.documents ? {report: state.documents.report} : {})} : fit));
            if (state.state === "done") say(`fit ${number}: ${state.documents!.report.verdict}`);
            if (state.state === "cancelled") say(`fit ${number} is cancelled`);
            if (state.state === "failed") onError(new Error(state.error));
            if (state.state !== "running") return;
            await pause(150);
        }
    };
    const start = async () => {
        const number = count + 1;
        try {
            const {name: job} = await api.startFit(orderOf(model, files));
            setCount(number);
            const state: FitState = {state: "running", progress: {stage: "starting", done: 0, total: 1}, seconds: 0};
            const measurement = Object.fromEntries(vocabulary.measurement_settings.map((name) => [name, model.settings[name] ?? null]));
            const ticked = files.filter(({visible: shown}) => shown.size > 0);
            setFits((all) => [...all, {number, job, names: shortened(targets.join(" + "), 80), files: ticked, measurement, state}]);
            say(`fit ${number} has begun`);
            await follow(number, job).catch((error: unknown) => {
                setFits((all) => all.filter((fit) => fit.number !== number));
                throw error;
            });
        } catch (error) {
            onError(error);
        }
    };
    const running = fits.filter(({state}) => state.state === "running");
    const done = fits.filter(({report}) => report);
    return (
        <section class="fits" aria-labelledby="fits-title">
            <h2 id="fits-title">Fit</h2>
            <p class="hint">
                {targets.length === 0
                    ? "Tick a measured spectrum; the parameters ticked “fit” are adjusted until the model explains it."
                    : `Explains ${shortened(listed(targets), 200)} by ${counted(model.free.length, "parameter")}, ` +
                      "starting from the sliders. Several spectra are explained together, as one specimen."}
            </p>
            <details>
                <summary>How it is fitted</summary>
                <Settings names={fitSettings} {...props} />
                <Discrepancy {...props} />
            </details>
            <button type="button" class="primary" disabled={targets.length === 0 || model.free.length === 0}
                onClick={() => void start()}>Fit</button>
            {running.map((fit) => <Running key={fit.number} fit={fit} onError={onError} />)}
            {done.length > 0 && <Comparison {...props} fits={done} />}
        </section>
    );
}

function Discrepancy({model, change}: FitsProps) {
    const isOn = model.settings["discrepancy"] !== null && model.settings["discrepancy"] !== undefined;
    return (
        <div class="setting">
            <label for="setting-discrepancy" title="the model's departure from real skin, a Gaussian process over wavelength">
                allow for the model's departure from real skin
            </label>
            <input id="setting-discrepancy" type="checkbox" checked={isOn}
                onChange={() => change({...model, settings: {...model.settings, discrepancy: isOn ? null : {}}})} />
        </div>
    );
}

function Running({fit, onError}: {fit: Fit; onError: (error: unknown) => void}) {
    const {stage, done, total} = fit.state.progress;
    return (
        <div class="running">
            <label for={`progress-${fit.number}`}>
                fit {fit.number}: {stage}{total > 1 ? `, ${done + 1} of ${total}` : ""}, {fit.state.seconds.toFixed(1)} s
            </label>
            <progress id={`progress-${fit.number}`} value={done} max={total} />
            <button type="button" onClick={() => void api.cancelFit(fit.job).catch(onError)}>Cancel fit {fit.number}</button>
        </div>
    );
}

/// A fitted value as the reports have it.
function valueOf({value, sigma, status, decided_by_prior, interval_95: [lower, upper]}: FittedParameter): string {
    if (status === "fixed") return shown(value);
    if (sigma !== null && !decided_by_prior) return withSigma(value, sigma);
    return `${shown(value)}, ${shown(lower, 3)} to ${shown(upper, 3)}`;
}

/// Draws the report of a fit for people, which takes a moment, and gives it to the reader.
function PageButton({fit: {number, job}, say, onError}: {fit: Fit} & Pick<FitsProps, "say" | "onError">) {
    const [isDrawn, setDrawn] = useState(true);
    const draw = async () => {
        setDrawn(false);
        try {
            download(`fit_${number}.html`, await api.report(job));
            say(`the report of fit ${number} is there`);
        } catch (error) {
            onError(error);
        }
        setDrawn(true);
    };
    return (
        <button type="button" aria-label={`report of fit ${number} as html`} disabled={!isDrawn} onClick={() => void draw()}
            title="one page with pictures, to be read, printed or attached">{isDrawn ? "HTML" : "HTML …"}</button>
    );
}

/// In what several fits differ, beside their answers.
function DifferenceRows({fits}: {fits: Fit[]}) {
    if (fits.length < 2) return null;
    const found = differencesOf(fits.map(({files, report}) => ({source: sourceOf(files), report: report!})));
    return (
        <tbody class="differences">
            <tr><th scope="rowgroup" colSpan={fits.length + 1}>{found.length > 0 ? "What differs" : "Nothing differs: file, settings and parameters are the same"}</th></tr>
            {found.map(({name, values}) => <tr><th scope="row">{name}</th>{values.map((value) => <td>{value}</td>)}</tr>)}
            <tr><th scope="rowgroup" colSpan={fits.length + 1}>The answers</th></tr>
        </tbody>
    );
}

function Comparison({vocabulary, model, change, setFiles, fits, setFits, say, onError}: FitsProps) {
    const rows = [...new Set(fits.flatMap(({report}) =>
        Object.entries(report!.parameters).filter(([, {status}]) => status !== "fixed").map(([name]) => name)))];
    const tissueRows = [...new Map(fits.flatMap(({report}) => report!.tissue.map((each): [string, TissueEstimate] => [each.name, each]))).values()];
    const unitOf = (name: string) => vocabulary.parameters.find((each) => each.name === name)?.unit ?? "";
    const toSliders = ({report, measurement, files}: Fit) => {
        change(withFitted(model, report!, measurement));
        setFiles((all) => showing(all, files));
    };
    const cells = (render: (report: Report, fit: Fit) => preact.ComponentChildren) =>
        fits.map((fit) => <td>{render(fit.report!, fit)}</td>);
    return (
        <Scrolled label="Fits side by side">
            <table class="comparison">
                <caption>Fitted values ± 1 sigma, or with 95 % intervals</caption>
                <thead>
                    <tr>
                        <th scope="col">parameter</th>
                        {fits.map(({number, names}) => <th scope="col">fit {number}<small>{names}</small></th>)}
                    </tr>
                </thead>
                <DifferenceRows fits={fits} />
                <tbody>
                    <tr>
                        <th scope="row">verdict</th>
                        {cells(({verdict, reasons}) => (
                            <details class={`verdict ${verdict}`}>
                                <summary>{verdict}</summary>
                                {reasons.length === 0 ? <p>nothing speaks against it</p> : <ul>{reasons.map((reason) => <li>{visible(reason)}</li>)}</ul>}
                            </details>
                        ))}
                    </tr>
                    {rows.map((name) => (
                        <tr>
                            <th scope="row">{inWords(name, unitOf(name))} <span class="unit">{unitOf(name)}</span></th>
                            {cells(({parameters}) => {
                                const found = parameters[name];
                                if (!found) return "–";
                                return <>{valueOf(found)}{["free", "fixed"].includes(found.status) ? "" : <em> {inWords(found.status)}</em>}
                                    {found.decided_by_prior ? <em> decided by its prior</em> : ""}</>;
                            })}
                        </tr>
                    ))}
                    {tissueRows.map(({name, unit}) => (
                        <tr>
                            <th scope="row">{inWords(name, unit)} <span class="unit">{unit}</span></th>
                            {cells(({tissue}) => {
                                const found = tissue.find((each) => each.name === name);
                                return found ? withInterval(found.value, found.interval_95) : "–";
                            })}
                        </tr>
                    ))}
                    {fits.some(({report}) => report!.split_by_model.length > 0) && <tr>
                        <th scope="row">split by the model</th>
                        {cells(({split_by_model: splits}) => splits.length === 0 ? "–" : splits.map(({message}) => <p>{visible(message)}</p>))}
                    </tr>}
                    <tr><th scope="row">rmse</th>{cells(({rmse}) => rmse.toFixed(5))}</tr>
                    <tr>
                        <th scope="row">chi2 / degrees of freedom</th>
                        {cells(({chi2, degrees_of_freedom: freedom}) => `${chi2.toFixed(1)} / ${freedom.toFixed(1)}`)}
                    </tr>
                    <tr>
                        <th scope="row">edition, engine</th>
                        {cells(({configuration}) => `${configuration["edition"]}, ${configuration["engine"]}`)}
                    </tr>
                    <tr>
                        <th scope="row"><span class="hidden">actions</span></th>
                        {cells((_, fit) => (
                            <div class="actions">
                                <button type="button" onClick={() => toSliders(fit)}
                                    aria-label={`sliders to fit ${fit.number}`}>To sliders</button>
                                {Object.entries(fit.state.documents!).map(([form, document]) => (
                                    <button type="button" aria-label={`report of fit ${fit.number} as ${endings[form] ?? form}`}
                                        onClick={() => download(`fit_${fit.number}.${endings[form] ?? form}`,
                                            typeof document === "string" ? document : JSON.stringify(document, null, 2))}>
                                        {(endings[form] ?? form).toUpperCase()}
                                    </button>
                                ))}
                                <PageButton fit={fit} say={say} onError={onError} />
                                <button type="button" aria-label={`remove fit ${fit.number}`}
                                    onClick={() => setFits((all) => all.filter(({number}) => number !== fit.number))}>Remove</button>
                            </div>
                        ))}
                    </tr>
                </tbody>
            </table>
        </Scrolled>
    );
}
