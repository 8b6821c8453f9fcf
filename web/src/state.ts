import type {Json, Report, Vocabulary} from "./types";
import {listed, visible} from "./words";

/// Everything that undo restores and a link holds. A setting that is null is not stated: the measured file decides it,
/// or the default.
export interface Model {
    values: {[parameter: string]: number};
    settings: {[setting: string]: Json};
    free: string[];
}

type Stated = {[parameter: string]: {value: number}};

const names = (json: Json | undefined): string[] => (Array.isArray(json) ? json.map(String) : []);

/// The model that a whole configuration describes, with the settings `open` left to measured files.
export function modelOf(configuration: {[key: string]: Json}, open: string[]): Model {
    const {parameters, free, own: _own, ...stated} = configuration;
    const settings = {...stated, ...Object.fromEntries(open.map((name) => [name, null]))};
    const values = Object.fromEntries(
        Object.entries((parameters ?? {}) as unknown as Stated).map(([name, {value}]) => [name, value]));
    return {values, settings, free: names(free)};
}

/// The model as the server takes it.
export const configurationOf = ({settings, values, free}: Model): Json =>
    ({...Object.fromEntries(Object.entries(settings).filter(([, value]) => value !== null)), parameters: values, free});

/// `model` with the values that a fit found, and the settings of the measurement that it was asked with: that of the fit.
/// Values of one spectrum alone, `name[2]`, have no slider.
export function withFitted(model: Model, report: Report, measurement: {[setting: string]: Json}): Model {
    const values = {...model.values};
    for (const [name, {value}] of Object.entries(report.parameters)) {
        if (name in values) values[name] = value;
    }
    return {...model, values, settings: {...model.settings, ...measurement}};
}

const same = (a: Json | undefined, b: Json | undefined) => JSON.stringify(a) === JSON.stringify(b);

/// What differs from the defaults, as the fragment of a link: `melanosome_fraction=0.1&edition=printed`.
export function fragmentOf(model: Model, defaults: Model): string {
    const parts = new URLSearchParams();
    for (const [name, value] of Object.entries(model.values)) {
        if (value !== defaults.values[name]) parts.set(name, String(value));
    }
    for (const [name, value] of Object.entries(model.settings)) {
        if (!same(value, defaults.settings[name])) parts.set(name, typeof value === "string" ? value : JSON.stringify(value));
    }
    if (!same(model.free, defaults.free)) parts.set("free", model.free.join(","));
    return parts.toString();
}

function settingFrom(text: string): Json {
    try {
        return JSON.parse(text) as Json;
    } catch {
        return text;
    }
}

/// The model that a fragment describes. What it says of unknown names, in no numbers, or beside what is `offered` for a
/// setting, is told in `complaints`.
export function modelFrom(fragment: string, defaults: Model, offered: {[setting: string]: Json[]} = {}): {model: Model; complaints: string[]} {
    const model = structuredClone(defaults);
    const complaints: string[] = [];
    for (const [name, text] of new URLSearchParams(fragment.replace(/^#/, ""))) {
        if (name === measuredKey) continue;
        if (name === "free") {
            const free = text.split(",").filter(Boolean);
            const unknown = free.filter((each) => !(each in defaults.values));
            if (unknown.length) complaints.push(`the link frees ${unknown.join(", ")}, which are no parameters`);
            model.free = Object.keys(defaults.values).filter((each) => free.includes(each));
        } else if (name in defaults.values) {
            const value = text.trim() === "" ? NaN : Number(text);
            if (Number.isFinite(value)) model.values[name] = value;
            else complaints.push(`the link gives ${name} as "${text}", which is no number`);
        } else if (name in defaults.settings) {
            const value = settingFrom(text);
            if (!offered[name] || offered[name].includes(value)) model.settings[name] = value;
            else complaints.push(`the link sets ${name} to "${text}", which this page does not offer; it offers ${listed(offered[name].map(String))}`);
        } else {
            complaints.push(`the link names "${name}", which is neither parameter nor setting`);
        }
    }
    return {model, complaints};
}

/// The name under which a link names files: of measured files, which it does not hold.
const measuredKey = "measured";

/// A file's name without its folders.
const baseName = (source: string): string => source.split(/[/\\]/).at(-1) ?? source;

/// `fragment` with the names of measured files.
export function withMeasured(fragment: string, sources: string[]): string {
    const parts = new URLSearchParams(fragment);
    for (const name of new Set(sources.map(baseName))) parts.append(measuredKey, name);
    return parts.toString();
}

/// The measured files that a fragment names and that are not among `sources`.
export function notLoaded(fragment: string, sources: string[]): string[] {
    const named = new URLSearchParams(fragment.replace(/^#/, "")).getAll(measuredKey);
    const loaded = new Set(sources.map(baseName));
    return [...new Set(named)].filter((name) => name !== "" && !loaded.has(name));
}

/// What to do about measured files that a link names and that are not loaded, in words.
export function inWordsNotLoaded(names: string[]): string {
    const are = names.length === 1 ? "the measured file" : "the measured files";
    const it = names.length === 1 ? "it" : "them";
    return `The link was made with ${are} ${listed(names.map(visible))}, which a link does not hold. The sliders are restored; to see and fit ` +
        `the measurement as well, choose ${it} under “Measured spectra”, or drop ${it} anywhere on the page.`;
}

/// The models that were, the one that is, and those that undo has left behind.
export interface History {
    past: Model[];
    present: Model;
    future: Model[];
    isMoving: boolean;  ///< in the middle of a slider's movement, which is one step
}

export const begun = (present: Model): History => ({past: [], present, future: [], isMoving: false});

const longest = 200;

/// `history` with another present; a movement counts as one step from its first change until it settles.
export function changed(history: History, present: Model, settles = true): History {
    if (!history.isMoving && present === history.present) return history;
    const past = history.isMoving ? history.past : [...history.past, history.present].slice(-longest);
    return {past, present, future: [], isMoving: !settles};
}

export function undone(history: History): History {
    const before = history.past.at(-1);
    if (!before) return history;
    return {past: history.past.slice(0, -1), present: before, future: [history.present, ...history.future], isMoving: false};
}

export function redone(history: History): History {
    const [next, ...future] = history.future;
    if (!next) return history;
    return {past: [...history.past, history.present], present: next, future, isMoving: false};
}

/// Where the page begins.
export const defaultsOf = (vocabulary: Vocabulary): Model => modelOf(vocabulary.configuration, vocabulary.measurement_settings);
