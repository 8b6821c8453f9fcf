import {inWords} from "./scale";
import type {Json, Measured, Measurement} from "./types";
import {visible} from "./words";

const has = (value: Json | undefined): value is Json => value !== undefined && value !== null;

/// A setting of the measurement in words, as in "incidence 45°"; nothing where it is not set.
function partOf(name: string, value: Json | undefined): string | undefined {
    if (!has(value)) return undefined;
    const text = visible(String(value));
    switch (name) {
        case "quantity": return text;
        case "incidence_deg": return `incidence ${text}°`;
        case "viewing_cone_deg": return `viewed within ${text}° of the normal`;
        case "bandpass_width_nm": return value === 0 ? undefined : `bandpass ${text} nm`;
        case "layers": return `${text} layers`;
        default: return `${inWords(name)} ${text}`;
    }
}

/// The settings `names` of a measurement in words; the shape of a bandpass without width is none.
export function inWordsMeasurement(measurement: {[setting: string]: Json | undefined}, names: string[]): string {
    const hasBand = has(measurement["bandpass_width_nm"]) && measurement["bandpass_width_nm"] !== 0;
    return names.filter((name) => name !== "bandpass_shape" || hasBand)
        .map((name) => partOf(name, measurement[name])).filter((part) => part !== undefined).join(", ");
}

/// What a spectrum states of the settings `names`, in words; "" for nothing. Its edition, layers and base are notes.
export function inWordsStated(statement: Measured, names: string[]): string {
    const notes = Array.isArray(statement["notes"]) ? (statement["notes"] as [string, string][]) : [];
    return inWordsMeasurement({...Object.fromEntries(notes), ...statement}, names);
}

/// The value of a setting that nobody has set here, and who decides it, as in "45 (file)".
export function inWordsDecided(name: string, {measurement, decided_by}: Measurement): string {
    const value = measurement[name];
    const nothing: {[name: string]: string} = {viewing_cone_deg: "hemisphere", instrument: "none"};
    const text = has(value) ? inWords(visible(String(value))) : nothing[name] ?? "none";
    const by = decided_by[name];
    return by === undefined || by === "stated" ? text : `${text} (${by})`;
}
