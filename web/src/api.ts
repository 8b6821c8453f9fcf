import type {Exported, FitState, Json, MeasuredFile, Sensitivity, Simulation, Vocabulary} from "./types";

/// The server does not answer any more.
export class ServerGone extends Error {}

const token = new URLSearchParams(location.search).get("token") ?? "";

async function ask(method: string, address: string, body?: string | ArrayBuffer): Promise<unknown> {
    let response: Response;
    try {
        response = await fetch(`api/${address}`, {
            method,
            headers: {"X-Skinfit-Token": token},
            ...(body === undefined ? {} : {body}),
        });
    } catch {
        throw new ServerGone("skinfit does not answer");
    }
    const answer = await response.json().catch(() => ({error: `an answer that is no JSON, status ${response.status}`}));
    if (!response.ok) throw new Error(answer.error ?? `status ${response.status}`);
    return answer;
}

const post = (address: string, json: unknown) => ask("POST", address, JSON.stringify(json));

export interface Order {
    configuration: Json;
    source: string;
    measured: Json;
}

export const api = {
    vocabulary: () => ask("GET", "vocabulary") as Promise<Vocabulary>,
    simulate: (configuration: Json) => post("simulate", {configuration}) as Promise<Simulation>,
    sensitivity: (configuration: Json) => post("sensitivity", {configuration}) as Promise<Sensitivity>,
    exported: (configuration: Json) => post("export", {configuration}) as Promise<Exported>,
    read: (name: string, bytes: ArrayBuffer) =>
        ask("POST", `spectra?name=${encodeURIComponent(name)}`, bytes) as Promise<MeasuredFile>,
    startFit: (order: Order) => post("fit", order) as Promise<{name: string}>,
    fit: (name: string) => ask("GET", `fit?name=${name}`) as Promise<FitState>,
    cancelFit: (name: string) => ask("DELETE", `fit?name=${name}`),
};
