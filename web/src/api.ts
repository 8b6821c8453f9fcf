import type {Exported, FitState, Json, Measured, MeasuredFile, Sensitivity, Simulation, Vocabulary} from "./types";
import {visible} from "./words";

/// The server does not answer any more.
export class ServerGone extends Error {}

const token = new URLSearchParams(location.search).get("token") ?? "";

const inJson = (response: Response): Promise<unknown> =>
    response.json().catch(() => ({error: `an answer that is no JSON, status ${response.status}`}));

async function response(method: string, address: string, body?: string | ArrayBuffer): Promise<Response> {
    let answer: Response;
    try {
        answer = await fetch(`api/${address}`, {
            method,
            headers: {"X-Skinfit-Token": token},
            ...(body === undefined ? {} : {body}),
        });
    } catch {
        throw new ServerGone("skinfit does not answer");
    }
    if (answer.ok) return answer;
    throw new Error(((await inJson(answer)) as {error?: string}).error ?? `status ${answer.status}`);
}

const ask = async (method: string, address: string, body?: string | ArrayBuffer) => inJson(await response(method, address, body));

const post = (address: string, json: unknown) => ask("POST", address, JSON.stringify(json));

/// A configuration, and the spectra that its model is to explain: a fit needs all of each, a curve what each states.
export interface Question {
    configuration: Json;
    source: string;
    measured: Measured[];
}

export const api = {
    vocabulary: () => ask("GET", "vocabulary") as Promise<Vocabulary>,
    simulate: (question: Question) => post("simulate", question) as Promise<{models: Simulation[]}>,
    sensitivity: (question: Question) => post("sensitivity", question) as Promise<Sensitivity>,
    exported: (question: Question) => post("export", question) as Promise<Exported>,
    sample: () => ask("GET", "sample") as Promise<MeasuredFile>,
    /// Of a file of `size` bytes, the bytes or their beginning.
    read: (name: string, bytes: ArrayBuffer, size: number) =>
        ask("POST", `spectra?name=${encodeURIComponent(visible(name))}&size=${size}`, bytes) as Promise<MeasuredFile>,
    startFit: (order: Question) => post("fit", order) as Promise<{name: string}>,
    fit: (name: string) => ask("GET", `fit?name=${name}`) as Promise<FitState>,
    report: async (name: string) => (await response("GET", `report?name=${name}`)).text(),
    cancelFit: (name: string) => ask("DELETE", `fit?name=${name}`),
};
