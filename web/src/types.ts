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
    statements: Measured[];  ///< of each of `measured`, all but its readings: for it a model can be drawn
}

export interface Vocabulary {
    version: string;
    parameters: Parameter[];
    groups: string[];
    layers: string[];
    instruments: string[];
    measurement_settings: string[];
    fit_engines: string[];
    largest_file_bytes: number;
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

/// For which measurement a model is drawn: the settings, and of each who decides it.
export interface Measurement {
    measurement: {[setting: string]: Json};
    decided_by: {[setting: string]: string};
}

export interface Simulation extends Measurement {
    spectra: number[];  ///< which statements of the question it is for
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

/// A quantity that does not depend on how the model divides the skin.
export interface TissueEstimate {
    name: string;
    value: number;
    unit: string;
    interval_95: [number, number] | null;
}

export interface FittedParameter {
    value: number;
    start: number;
    sigma: number | null;
    interval_95: [number, number];
    status: string;
    decided_by_prior: boolean;
    unit: string;
}

/// A spectrum and its explanation.
export interface Explained {
    name: string;
    wavelength_nm: number[];
    measured: number[];
    sigma: number[];
    modelled: number[];
    residual: number[];
}

/// Of one spectrum its readings stand in the report, of several in `spectra`.
export interface Report extends Partial<Explained> {
    verdict: string;
    reasons: string[];
    rmse: number;
    chi2: number;
    degrees_of_freedom: number;
    parameters: {[name: string]: FittedParameter};
    tissue: TissueEstimate[];
    split_by_model: {message: string}[];
    spectrum?: {name: string};
    spectra?: Explained[];
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
    simulations: {csv: string; json: Json}[];
    configuration: Json;
}
