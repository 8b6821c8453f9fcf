import {useMemo} from "preact/hooks";
import {Field} from "./field";
import type {Model} from "./state";
import {inWordsDecided} from "./measurement";
import {inWords, rounded, scaleOf, shown} from "./scale";
import type {Json, Measurement, Parameter, SettingSchema, Vocabulary} from "./types";

/// Another model, and whether a movement has come to its end.
export type Change = (model: Model, settles?: boolean, event?: Event) => void;

interface PanelProps {
    vocabulary: Vocabulary;
    defaults: Model;
    model: Model;
    measurement?: Measurement | undefined;  ///< for which the model is drawn
    change: Change;
}

const openGroups = ["epidermis", "blood"];

export function Parameters(props: PanelProps) {
    const {vocabulary, model, defaults, change} = props;
    return (
        <section class="parameters" aria-label="Parameters of the skin and the instrument">
            {vocabulary.groups.map((group) => (
                <details open={openGroups.includes(group)} class="group">
                    <summary><h2>{group}</h2></summary>
                    {vocabulary.parameters.filter((each) => each.group === group).map((each) => (
                        <ParameterRow key={each.name} parameter={each} {...props} />
                    ))}
                </details>
            ))}
            <details class="group">
                <summary><h2>measurement</h2></summary>
                <p class="hint">What is left open is taken from the measured file that is ticked, else from the defaults.</p>
                <Settings names={[...vocabulary.measurement_settings, "wavelengths"]} {...props} />
            </details>
            <button type="button" onClick={() => change(defaults)} disabled={model === defaults}>Back to the defaults</button>
        </section>
    );
}

function ParameterRow({parameter, model, change}: PanelProps & {parameter: Parameter}) {
    const {name, unit} = parameter;
    const scale = useMemo(() => scaleOf(parameter), [parameter]);
    const value = model.values[name] ?? parameter.default;
    const set = (next: number, settles: boolean, event: Event) => {
        if (!Number.isFinite(next)) return;
        change(next === value ? model : {...model, values: {...model.values, [name]: next}}, settles, event);
    };
    const onSlide = (settles: boolean) => (event: Event) =>
        set(rounded(scale.toValue(Number((event.target as HTMLInputElement).value) / 1000)), settles, event);
    const toggle = () => change({
        ...model,
        free: model.free.includes(name) ? model.free.filter((each) => each !== name) : [...model.free, name],
    });
    const words = inWords(name, unit);
    return (
        <div class="parameter" data-parameter={name}>
            <label for={`number-${name}`} title={`${parameter.meaning}; ${parameter.source}`}>{words}</label>
            <span class="number">
                <Field id={`number-${name}`} type="number" step="any" min={parameter.lowest} max={parameter.highest} value={String(value)}
                    settle={(text, event) => set(text === "" ? NaN : Number(text), true, event)} />
                <span class="unit">{unit}</span>
            </span>
            <span class="slider">
                <UsualRange parameter={parameter} />
                <input type="range" min="0" max="1000" step="1" value={Math.round(1000 * scale.toPosition(value))}
                    aria-label={`${words}, ${scale.kind} slider`}
                    aria-valuetext={`${shown(value)} ${unit}`.trim()}
                    onInput={onSlide(false)} onChange={onSlide(true)} />
            </span>
            <label class="free" title="adjust this parameter in a fit">
                <input type="checkbox" checked={model.free.includes(name)} onChange={toggle} aria-label={`fit ${words}`} />
                <span aria-hidden="true">fit</span>
            </label>
        </div>
    );
}

function UsualRange({parameter}: {parameter: Parameter}) {
    const {usual, unit} = parameter;
    if (!usual) return null;
    const scale = scaleOf(parameter);
    const from = 100 * scale.toPosition(usual.lower);
    const to = 100 * scale.toPosition(usual.upper);
    const words = `healthy skin ${shown(usual.lower, 3)} to ${shown(usual.upper, 3)} ${unit}`;
    return (
        <span class="usual" style={{left: `${from}%`, width: `${to - from}%`}} title={`${words}; ${usual.source}`}>
            <span class="hidden">{words}</span>
        </span>
    );
}

/// Settings as their schema describes them.
export function Settings({names, vocabulary, model, measurement, change}: PanelProps & {names: string[]}) {
    return (
        <>
            {names.filter((name) => name in vocabulary.schema.properties).map((name) => (
                <SettingRow key={name} name={name} schema={vocabulary.schema.properties[name]!} vocabulary={vocabulary}
                    value={model.settings[name] ?? null}
                    open={measurement && vocabulary.measurement_settings.includes(name) ? inWordsDecided(name, measurement) : "default"}
                    change={(value) => change({...model, settings: {...model.settings, [name]: value}})} />
            ))}
        </>
    );
}

interface SettingProps {
    name: string;
    schema: SettingSchema;
    vocabulary: Vocabulary;
    value: Json;
    open: string;  ///< what holds where it is not set
    change: (value: Json) => void;
}

/// The values to choose from; none where any number or text will do.
function choicesOf({name, schema, vocabulary}: SettingProps): Json[] | undefined {
    if (name === "instrument") return [null, ...vocabulary.instruments];
    if (name === "engine") return vocabulary.fit_engines;
    const choices = schema.enum ?? schema.anyOf?.find((each) => each.enum)?.enum;
    const isOpen = vocabulary.measurement_settings.includes(name) && choices?.includes(null) === false;
    return isOpen ? [null, ...choices] : choices;
}

function SettingRow(props: SettingProps) {
    const {name, schema, value, open, change} = props;
    const choices = choicesOf(props);
    const id = `setting-${name}`;
    const takesNumber = [schema.type].flat().some((type) => type === "number" || type === "integer") && name !== "wavelengths";
    const settle = (typed: string) => {
        const text = typed.trim();
        change(text === "" ? null : takesNumber ? Number(text) : text);
    };
    return (
        <div class="setting">
            <label for={id} title={schema.description}>{inWords(name)}</label>
            {choices
                ? <select id={id} value={JSON.stringify(value)}
                    onChange={(event) => change(JSON.parse((event.target as HTMLSelectElement).value) as Json)}>
                    {choices.map((choice) => (
                        <option value={JSON.stringify(choice)}>{choice === null ? open : inWords(String(choice))}</option>
                    ))}
                </select>
                : <Field id={id} type={takesNumber ? "number" : "text"} step="any" min={schema.minimum} max={schema.maximum}
                    value={value === null ? "" : String(value)} placeholder={open} settle={settle} />}
        </div>
    );
}
