import {useEffect, useMemo, useState} from "preact/hooks";
import {api} from "./api";
import type {Fit} from "./fits";
import {Following} from "./following";
import type {OpenFile} from "./measured";
import {Plot, type Curve} from "./plot";
import {counted, inWords, shortened} from "./scale";
import type {Model} from "./state";
import type {Colour, Sensitivity, Simulation, Vocabulary} from "./types";

const views = ["spectrum", "absorption", "sensitivity"] as const;
type View = (typeof views)[number];

interface ViewsProps {
    vocabulary: Vocabulary;
    model: Model;
    simulation: Simulation;
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

function SpectrumView({simulation, files, fits, onDrawn}: ViewsProps) {
    const colour = usePalette();
    const model = colour("accent");
    const curves = useMemo((): Curve[] => [
        {label: "model", x: simulation.wavelength_nm, y: simulation.reading, colour: model, look: "line"},
        ...files.flatMap((file, k) => file.measured.filter((_, i) => file.visible.has(i)).map((spectrum): Curve => ({
            label: shortened(spectrum.name),
            x: spectrum.wavelength_nm,
            y: spectrum.value,
            colour: colour(palette[k % palette.length]!),
            look: "points",
        }))),
        ...fits.filter((fit) => fit.report?.modelled).map((fit, k): Curve => ({
            label: `fit ${fit.number}`,
            x: fit.report!.wavelength_nm,
            y: fit.report!.modelled,
            colour: colour(palette[(k + 3) % palette.length]!),
            look: "dashed",
        })),
    ], [simulation, files, fits, model]);
    const {wavelength_nm: nm, reading} = simulation;
    const description = `${simulation.quantity} of the model from ${nm[0]} to ${nm.at(-1)} nm: ` +
        `${percent(reading[0]!)} at the short end, ${percent(reading.at(-1)!)} at the long end, ` +
        `with ${counted(curves.length - 1, "other curve")}`;
    return <Plot curves={curves} yLabel={simulation.quantity} description={description} fromZero onDrawn={onDrawn} />;
}

function AbsorptionView({simulation, onDrawn}: ViewsProps) {
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

function SensitivityView({model, vocabulary, onDrawn, onError}: ViewsProps) {
    const colour = usePalette();
    const [found, setFound] = useState<Sensitivity>();
    const following = useMemo(() => new Following(api.sensitivity, setFound, onError), []);
    useEffect(() => following.want(model), [model]);
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
