// What the server says: the project's vocabulary, with the keys of its reports.

export type Json = null | boolean | number | string | Json[] | {[key: string]: Json};

export interface Parameter {
    name: string;
    unit: string;
    group: string;
    meaning: string;
    source: string;
    lowest: number;
    highest: number;
    lower: number;
    upper: number;
    steers: boolean;
    logarithmic: boolean;
    default: number;
    usual: {lower: number; upper: number; source: string} | null;
}

export interface SettingSchema {
    description?: string;
    enum?: Json[];
    type?: string | string[];
    anyOf?: SettingSchema[];
    minimum?: number;
    maximum?: number;
}

export interface Finding {
    name: string;
    severity: string;
    spectrum: string;
    message: string;
    remedy: string;
}

/// A spectrum in the form of `skinfit convert --format json`; goes back to the server as it came.
export interface Measured {
    name: string;
    wavelength_nm: number[];
    value: number[];
    [key: string]: Json;
}

export interface MeasuredFile {
    source: string;
    format: string;
    unit_rule: string;
    findings: Finding[];
    measured: Measured[];
}

export interface Vocabulary {
    version: string;
    parameters: Parameter[];
    groups: string[];
    layers: string[];
    instruments: string[];
    configuration: {[key: string]: Json};
    schema: {properties: {[key: string]: SettingSchema}};
    file: MeasuredFile | null;
}

export interface Colour {
    hex?: string;
    in_gamut?: boolean;
    lab?: [number, number, number];
    individual_typology_angle_deg?: number | null;
    skin_colour?: string | null;
    unknown?: string;
}

export interface Simulation {
    quantity: string;
    wavelength_nm: number[];
    reading: number[];
    shares: {[where: string]: number[]};
    colour: Colour;
}

export interface Sensitivity {
    wavelength_nm: number[];
    derivative: {[parameter: string]: number[]};
}

export interface FittedParameter {
    value: number;
    sigma: number | null;
    interval_95: [number, number];
    status: string;
    decided_by_prior: boolean;
    unit: string;
}

export interface Report {
    verdict: string;
    reasons: string[];
    rmse: number;
    chi2: number;
    degrees_of_freedom: number;
    parameters: {[name: string]: FittedParameter};
    wavelength_nm: number[];
    measured: number[];
    modelled: number[];
    configuration: {[key: string]: Json};
}

export interface FitState {
    state: "running" | "done" | "cancelled" | "failed";
    progress: {stage: string; done: number; total: number};
    seconds: number;
    documents?: {report: Report; text: string; [form: string]: Json | Report};
    error?: string;
}

export interface Exported {
    csv: string;
    json: Json;
    configuration: Json;
}
