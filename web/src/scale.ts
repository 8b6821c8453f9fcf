import type {Parameter} from "./types";

/// How a slider's position, 0 to 1, stands for a value.
export interface Scale {
    kind: "linear" | "logarithmic";
    toValue(position: number): number;
    toPosition(value: number): number;
}

const clamp = (position: number) => Math.min(1, Math.max(0, position));

/// Logarithmic where fits search on such a scale; a range that begins at 0 shows four decades below its top, with 0 at
/// the very end.
export function scaleOf({lower, upper, logarithmic}: Parameter): Scale {
    if (!logarithmic) {
        return {
            kind: "linear",
            toValue: (position) => lower + position * (upper - lower),
            toPosition: (value) => clamp((value - lower) / (upper - lower)),
        };
    }
    const bottom = lower === 0 ? upper * 1e-4 : lower;
    return {
        kind: "logarithmic",
        toValue: (position) => (position <= 0 ? lower : bottom * Math.pow(upper / bottom, position)),
        toPosition: (value) => (value <= bottom ? 0 : clamp(Math.log(value / bottom) / Math.log(upper / bottom))),
    };
}

/// Three significant digits, as a slider means them.
export const rounded = (value: number): number => Number(value.toPrecision(3));

/// A number as people write it: up to `digits` significant ones.
export function shown(value: number, digits = 4): string {
    if (value === 0) return "0";
    const size = Math.abs(value);
    return size >= 1e-3 && size < 1e5 ? String(Number(value.toPrecision(digits))) : value.toExponential(digits - 2);
}

/// `value` rounded to two digits of `sigma`, as the reports have it.
export function withSigma(value: number, sigma: number): string {
    const decimals = Math.min(12, Math.max(0, 1 - Math.floor(Math.log10(sigma))));
    return `${value.toFixed(decimals)} ± ${sigma.toFixed(decimals)}`;
}

/// `value` with the ends of its 95 % interval, as the reports have it.
export const withInterval = (value: number, interval: [number, number] | null): string =>
    interval ? `${shown(value, 3)}, ${shown(interval[0], 3)} to ${shown(interval[1], 3)}` : shown(value, 3);

/// "1 finding", "2 findings".
export const counted = (count: number, one: string, more = `${one}s`): string => `${count} ${count === 1 ? one : more}`;

const units: {[unit: string]: string} = {"g/L": "_g_per_l", "mg/dL": "_mg_per_dl", "umol/L": "_umol_per_l", cm: "_cm", nm: "_nm"};

/// A parameter's or setting's name in words, without the unit that stands beside it.
export function inWords(name: string, unit = ""): string {
    const suffix = units[unit] ?? "";
    const bare = suffix && name.endsWith(suffix) ? name.slice(0, -suffix.length) : name;
    return bare.replaceAll("_", " ").replace(/ deg$/, " (°)").replace(/ nm$/, " (nm)");
}
