import {useEffect, useMemo, useState} from "preact/hooks";
import {api} from "./api";
import {explainedBy} from "./differences";
import {modelLabels, modelOfShown, questionOf, type Drawn} from "./drawn";
import type {Fit} from "./fits";
import {Following} from "./following";
import {shownOf, type OpenFile} from "./measured";
import {inWordsMeasurement} from "./measurement";
import {Plot, type Curve} from "./plot";
import {residualsOf} from "./residuals";
import {counted, inWords} from "./scale";
import type {Model} from "./state";
import type {Colour, Json, Sensitivity, Vocabulary} from "./types";
import {shortened} from "./words";

const views = ["spectrum", "absorption", "sensitivity"] as const;
type View = (typeof views)[number];

interface ViewsProps {
    vocabulary: Vocabulary;
    model: Model;
    drawn: Drawn;
    files: OpenFile[];
    fits: Fit[];
    onDrawn: () => void;
    onError: (error: unknown) => void;
}

export function Views(props: ViewsProps) {
    const [view, setView] = useState<View>("spectrum");
    const onKey = (event: KeyboardEvent) => {
        const step = {ArrowRight: 1, ArrowLeft: -1}[event.key];
        if (!step) return;
        const next = views[(views.indexOf(view) + step + views.length) % views.length]!;
        setView(next);
        document.getElementById(`tab-${next}`)?.focus();
    };
    return (
        <section class="views" aria-label="What the model says">
            <div role="tablist" aria-label="Views" onKeyDown={onKey}>
                {views.map((each) => (
                    <button type="button" role="tab" id={`tab-${each}`} aria-controls="view" aria-selected={each === view}
                        tabIndex={each === view ? 0 : -1} onClick={() => setView(each)}>{each}</button>
                ))}
            </div>
            <div role="tabpanel" id="view" aria-labelledby={`tab-${view}`}>
                {view === "spectrum" && <SpectrumView {...props} />}
                {view === "absorption" && <AbsorptionView {...props} />}
                {view === "sensitivity" && <SensitivityView {...props} />}
            </div>
        </section>
    );
}

export const palette = ["var-1", "var-2", "var-3", "var-4", "var-5", "var-6", "var-7", "var-8"];

/// The colours of the style sheet as they are now: a canvas knows no variables.
export const colourOf = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

function usePalette(): (name: string) => string {
    const [, again] = useState(0);
    useEffect(() => {
        const scheme = matchMedia("(prefers-color-scheme: dark)");
        const onChange = () => again((count) => count + 1);
        scheme.addEventListener("change", onChange);
        return () => scheme.removeEventListener("change", onChange);
    }, []);
    return colourOf;
}

const percent = (value: number) => `${(100 * value).toFixed(1)} %`;

type Palette = (name: string) => string;

const hueOf = (k: number, colour: Palette) => colour(palette[k % palette.length]!);

/// The fits with the number of the colour that each has in every plot.
const fitCurves = (fits: Fit[], colour: Palette, take: (explained: ReturnType<typeof explainedBy>[number]) => number[]): Curve[] =>
    fits.flatMap((fit, k) => (fit.report ? explainedBy(fit.report) : []).map((explained, _, {length}): Curve => ({
        label: length === 1 ? `fit ${fit.number}` : `fit ${fit.number}, ${shortened(explained.name)}`,
        x: explained.wavelength_nm,
        y: take(explained),
        colour: hueOf(k + 3, colour),
        look: "dashed",
    })));

function curvesOf({drawn, files, fits}: ViewsProps, colour: Palette): Curve[] {
    const labels = modelLabels(drawn.models);
    return [
        ...drawn.models.map((model, k): Curve => ({
            label: labels[k]!, x: model.wavelength_nm, y: model.reading, colour: k === 0 ? colour("accent") : hueOf(k + 4, colour), look: "line",
        })),
        ...shownOf(files).map(({file, spectrum}): Curve => ({
            label: shortened(spectrum.name), x: spectrum.wavelength_nm, y: spectrum.value, colour: hueOf(files.indexOf(file), colour), look: "points",
        })),
        ...fitCurves(fits, colour, ({modelled}) => modelled),
    ];
}

/// Of what is measured and shown: the noise of the first, between two edges, and the model and the fits minus it.
function residualCurvesOf({drawn, files, fits}: ViewsProps, colour: Palette): Curve[] {
    const shown = shownOf(files);
    const models = shown.flatMap(({file, spectrum, statement}) => {
        const model = modelOfShown(drawn, statement);
        return model ? [{file, spectrum, model, ...residualsOf(model, spectrum)}] : [];
    });
    const first = models[0];
    if (!first || first.x.length === 0) return [];
    const sigma = first.indices.map((i) => (first.spectrum["sigma"] as number[] | undefined)?.[i] ?? Number(first.model.measurement["noise"]));
    const edge = (sign: number, label: string): Curve =>
        ({label, x: first.x, y: sigma.map((each) => sign * each), colour: colour("var-8"), look: "edge"});
    return [
        edge(1, "+1 sigma"),
        edge(-1, "-1 sigma"),
        ...models.map(({file, spectrum, x, y}): Curve => ({
            label: `model − ${shortened(spectrum.name)}`, x, y, colour: models.length === 1 ? colour("accent") : hueOf(files.indexOf(file), colour), look: "line",
        })),
        ...fitCurves(fits, colour, ({residual}) => residual),
    ];
}

/// For what the model is drawn, in words.
function DrawnFor({drawn, names}: {drawn: Drawn; names: string[]}) {
    const labels = modelLabels(drawn.models);
    return (
        <div class="drawn-for">
            {drawn.models.map(({measurement, decided_by}, k) => {
                const words = (by: string) => inWordsMeasurement(
                    Object.fromEntries(names.filter((name) => decided_by[name] === by).map((name): [string, Json] => [name, measurement[name] ?? null])), names);
                const parts = [["file", "as the file says"], ["stated", "as set here"], ["instrument", "of the instrument"], ["default", "by default"]]
                    .map(([by, how]) => [words(by!), how]).filter(([found]) => found).map(([found, how]) => `${found} (${how})`);
                return <p><strong>{labels[k]}</strong> drawn for {parts.join("; ")}</p>;
            })}
        </div>
    );
}

function SpectrumView(props: ViewsProps) {
    const {drawn, files, fits, vocabulary, onDrawn} = props;
    const colour = usePalette();
    const accent = colour("accent");
    const curves = useMemo(() => curvesOf(props, colour), [drawn, files, fits, accent]);
    const residuals = useMemo(() => residualCurvesOf(props, colour), [drawn, files, fits, accent]);
    const {quantity, wavelength_nm: nm, reading} = drawn.models[0]!;
    const description = `${quantity} of the model from ${nm[0]} to ${nm.at(-1)} nm: ` +
        `${percent(reading[0]!)} at the short end, ${percent(reading.at(-1)!)} at the long end, ` +
        `with ${counted(curves.length - 1, "other curve")}`;
    const ends = curves.flatMap(({x}) => [x[0]!, x.at(-1)!]);
    return (
        <>
            <Plot curves={curves} yLabel={quantity} description={description} fromZero onDrawn={onDrawn} />
            {residuals.length > 0 && (
                <Plot curves={residuals} yLabel="residual" isSmall xRange={[Math.min(...ends), Math.max(...ends)]}
                    description={`Below it the residuals: ${residuals.slice(2).map(({label}) => label).join(", ")}`} />
            )}
            {residuals.length > 0 && (
                <p class="hint">Residual: model minus measured; shaded: one sigma of the noise of {residuals[2]!.label.replace("model − ", "")}.</p>
            )}
            <DrawnFor drawn={drawn} names={vocabulary.measurement_settings} />
        </>
    );
}

function AbsorptionView({drawn, onDrawn}: ViewsProps) {
    const simulation = drawn.models[0]!;
    const colour = usePalette();
    const names = Object.keys(simulation.shares).filter((name) => simulation.shares[name]!.some((share) => share > 1e-6));
    const hues = names.map((_, k) => colour(palette[k % palette.length]!));
    const curves = useMemo(() => {
        let stacked = simulation.wavelength_nm.map(() => 0);
        const areas = names.map((name, k): Curve => {
            stacked = stacked.map((below, i) => below + simulation.shares[name]![i]!);
            return {label: inWords(name), x: simulation.wavelength_nm, y: stacked, colour: hues[k]!, look: "area", share: simulation.shares[name]!};
        });
        return areas.reverse();  // the highest first, so that the lower ones lie upon it
    }, [simulation, ...hues]);
    return (
        <>
            <Plot curves={curves} yLabel="share of the light" fromZero top={1} onDrawn={onDrawn}
                description="Where the light ends, stacked: reflected by the surface, left again, absorbed by each layer" />
            <p class="hint">Stacked shares of the incident light: what the surface reflects, what leaves again, and what each layer absorbs.</p>
        </>
    );
}

function SensitivityView({model, files, vocabulary, onDrawn, onError}: ViewsProps) {
    const colour = usePalette();
    const [found, setFound] = useState<Sensitivity>();
    const following = useMemo(() => new Following(api.sensitivity, setFound, onError), []);
    useEffect(() => following.want(questionOf(model, files)), [model, files]);
    const first = colour(palette[0]!);
    const curves = useMemo((): Curve[] => {
        if (!found) return [];
        return model.free.filter((name) => found.derivative[name]).map((name, k) => ({
            label: inWords(name, vocabulary.parameters.find((each) => each.name === name)?.unit),
            x: found.wavelength_nm,
            y: found.derivative[name]!,
            colour: colour(palette[k % palette.length]!),
            look: "line",
        }));
    }, [found, first]);
    if (!found) return <p class="hint">Computing …</p>;
    if (curves.length === 0) return <p class="hint">Tick “fit” beside a parameter to see which wavelengths inform it.</p>;
    return (
        <>
            <Plot curves={curves} yLabel="change of the reading" onDrawn={onDrawn}
                description={`How the reading answers to ${curves.map(({label}) => label).join(", ")}`} />
            <p class="hint">Change of the reading for a change of a parameter by its own size, to first order, for the parameters ticked “fit”.</p>
        </>
    );
}

export function Swatch({colour}: {colour: Colour}) {
    if (!colour.hex) return <p class="hint">{colour.unknown}</p>;
    const angle = colour.individual_typology_angle_deg;
    const words = colour.skin_colour ? `${colour.skin_colour}, ITA ${angle!.toFixed(1)}°` : "no typology angle";
    return (
        <figure class="swatch">
            <div style={{background: colour.hex}} role="img" aria-label={`colour of this skin: ${colour.hex}`} />
            <figcaption>
                <strong>{words}</strong>
                <span>L*a*b* {colour.lab!.map((value) => value.toFixed(1)).join(", ")}</span>
                <span>sRGB {colour.hex}{colour.in_gamut ? "" : ", cut to what a screen can show"}, under D65</span>
            </figcaption>
        </figure>
    );
}
