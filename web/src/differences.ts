import {inWords, shown} from "./scale";
import type {Explained, FittedParameter, Json, Report} from "./types";
import {listed, visible} from "./words";

/// A fit that is compared: its answer, and the files of its spectra.
export interface Compared {
    source: string;
    report: Report;
}

/// Something in which fits differ, and what it is in each of them.
export interface Difference {
    name: string;
    values: string[];
}

/// The spectra that a report explains.
export const explainedBy = (report: Report): Explained[] =>
    report.spectra ?? [{...report, name: report.spectrum!.name} as Explained];

/// The parts of an object as "name value".
const parts = (object: {[name: string]: Json}): string =>
    Object.entries(object).filter(([, each]) => each !== null).map(([name, each]) => `${inWords(name)} ${text(each)}`).join(", ");

function text(value: Json | undefined): string {
    if (value === undefined || value === null) return "none";
    if (Array.isArray(value)) return value.length === 0 ? "none" : visible(JSON.stringify(value));
    return typeof value === "object" ? parts(value) : visible(String(value));
}

function readings(report: Report): string {
    const all = explainedBy(report).flatMap(({wavelength_nm}) => wavelength_nm);
    return `${all.length}, ${Math.min(...all)} to ${Math.max(...all)} nm`;
}

const isFixed = (parameter: FittedParameter | undefined) => parameter?.status === "fixed";
const free = (report: Report) => Object.entries(report.parameters).filter(([, each]) => !isFixed(each)).map(([name]) => name);

/// What a configuration says of a parameter beside its value: bounds and prior.
function limits(report: Report, name: string): string {
    const stated = (report.configuration["parameters"] as {[name: string]: {[key: string]: Json}} | undefined)?.[name];
    const {value: _value, ...rest} = stated ?? {};
    return parts(rest);
}

function parameterDifferences(reports: Report[]): [string, string[]][] {
    const names = [...new Set(reports.flatMap(({parameters}) => Object.keys(parameters)))];
    return names.flatMap((name): [string, string[]][] => {
        const found = reports.map(({parameters}) => parameters[name]);
        if (found.every(isFixed)) return [[`${name}, held`, found.map((each) => shown(each!.value))]];
        if (found.some((each) => !each || isFixed(each))) return [];
        return [[`${name}, start`, found.map((each) => shown(each!.start))], [`${name}, limits`, reports.map((report) => limits(report, name))]];
    });
}

/// In what fits differ beside their answers: files and spectra, window, settings, parameters that are free, held, begun
/// or limited otherwise.
export function differencesOf(fits: Compared[]): Difference[] {
    const reports = fits.map(({report}) => report);
    const inAll = free(reports[0]!).filter((name) => reports.every((report) => free(report).includes(name)));
    const settings = [...new Set(reports.flatMap(({configuration}) => Object.keys(configuration)))]
        .filter((name) => !["parameters", "free"].includes(name));
    const rows: [string, string[]][] = [
        ["file", fits.map(({source}) => visible(source))],
        ["spectrum", reports.map((report) => listed(explainedBy(report).map(({name}) => visible(name))))],
        ["readings", reports.map(readings)],
        ...settings.map((name): [string, string[]] => [name, reports.map(({configuration}) => text(configuration[name]))]),
        ["free beside the others", reports.map((report) =>
            listed(free(report).filter((name) => !inAll.includes(name)).map((name) => inWords(name))) || "none")],
        ...parameterDifferences(reports),
    ];
    return rows.filter(([, values]) => new Set(values).size > 1).map(([name, values]) => ({name: inWords(name), values}));
}
