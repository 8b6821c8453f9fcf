import type {Question} from "./api";
import {shownOf, type OpenFile} from "./measured";
import {inWordsMeasurement} from "./measurement";
import {configurationOf, type Model} from "./state";
import type {Measured, Simulation} from "./types";

/// Models as they are drawn, and for which statements of measured files they were asked.
export interface Drawn {
    models: Simulation[];
    statements: string[];
}

const keyOf = (statement: Measured) => JSON.stringify(statement);

/// What to ask the server for `model` beside the spectra that are shown: it is drawn as a fit of them would take it.
export function questionOf(model: Model, files: OpenFile[]): Question {
    const shown = shownOf(files);
    const distinct = new Map(shown.map(({statement}) => [keyOf(statement), statement]));
    return {
        configuration: configurationOf(model),
        source: [...new Set(shown.map(({file}) => file.source))].join(", ") || "the page",
        measured: [...distinct.values()],
    };
}

export const drawnFor = (models: Simulation[], {measured}: Question): Drawn => ({models, statements: measured.map(keyOf)});

/// The model that a fit of the spectrum with this statement would take; nothing until it is drawn.
export const modelOfShown = ({models, statements}: Drawn, statement: Measured): Simulation | undefined =>
    models.find(({spectra}) => spectra.some((i) => statements[i] === keyOf(statement)));

/// "model", or what tells several apart.
export function modelLabels(models: Simulation[]): string[] {
    const names = Object.keys(models[0]!.measurement).filter((name) =>
        new Set(models.map(({measurement}) => JSON.stringify(measurement[name]))).size > 1);
    return models.map(({measurement}, k) =>
        (models.length === 1 ? "model" : `model ${k + 1}: ${inWordsMeasurement(measurement, names) || "defaults"}`));
}
