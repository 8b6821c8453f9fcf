import type {Exported, FitState, Json, MeasuredFile, Sensitivity, Simulation, Vocabulary} from "./types";

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
    report: async (name: string) => (await response("GET", `report?name=${name}`)).text(),
    cancelFit: (name: string) => ask("DELETE", `fit?name=${name}`),
};
