import {useRef} from "preact/hooks";
import {api} from "./api";
import {inWordsStated} from "./measurement";
import {counted} from "./scale";
import type {Measured, MeasuredFile} from "./types";
import {visible} from "./words";

/// A file that is shown, and which of its spectra are.
export interface OpenFile extends MeasuredFile {
    visible: Set<number>;
}

/// A spectrum that is shown, and what its file states of it.
export interface Shown {
    file: OpenFile;
    spectrum: Measured;
    statement: Measured;
}

export const opened = (file: MeasuredFile): OpenFile => ({...file, visible: new Set(file.measured.length ? [0] : [])});

/// The spectra that are ticked.
export const shownOf = (files: OpenFile[]): Shown[] => files.flatMap((file) => file.measured
    .map((spectrum, i) => ({file, spectrum, statement: file.statements[i]!}))
    .filter((_, i) => file.visible.has(i)));

/// `files` with exactly those spectra ticked that are in `wanted`, which are there again if they were removed.
export function showing(files: OpenFile[], wanted: OpenFile[]): OpenFile[] {
    const isSame = (a: OpenFile) => (b: OpenFile) => a.measured === b.measured;
    const kept = files.map((file) => ({...file, visible: wanted.find(isSame(file))?.visible ?? new Set<number>()}));
    return [...kept, ...wanted.filter((file) => !files.some(isSame(file)))];
}

interface MeasuredProps {
    names: string[];  ///< of the settings that a file decides
    files: OpenFile[];
    setFiles: (update: (files: OpenFile[]) => OpenFile[]) => void;
    read: (chosen: FileList | null | undefined) => Promise<void>;
    say: (message: string) => void;
    onError: (error: unknown) => void;
}

/// A file as the server reads it. Of one too large to be sent the beginning goes there, for the server to say what it is.
export async function sent(file: File, largest: number): Promise<MeasuredFile> {
    let bytes: ArrayBuffer;
    try {
        bytes = await (file.size > largest ? file.slice(0, 4096) : file).arrayBuffer();
    } catch {
        throw new Error(`${file.name}: cannot be read (it is a folder, or not there any more); choose a file`);
    }
    return api.read(file.name, bytes, file.size);
}

/// What came of a file, in words.
export const inWordsRead = ({source, measured, findings}: MeasuredFile): string =>
    `${visible(source)}: ${counted(measured.length, "spectrum", "spectra")}, ${counted(findings.length, "finding")}`;

export function MeasuredFiles({names, files, setFiles, read, say, onError}: MeasuredProps) {
    const input = useRef<HTMLInputElement>(null);
    const take = async () => {
        try {
            const sample = await api.sample();
            setFiles((all) => [...all, opened(sample)]);
            say(inWordsRead(sample));
        } catch (error) {
            onError(error);
        }
    };
    const replace = (file: OpenFile, by: OpenFile[]) => setFiles((all) => all.flatMap((each) => (each === file ? by : [each])));
    return (
        <section class="measured" aria-labelledby="measured-title">
            <h2 id="measured-title">Measured spectra</h2>
            <div class="drop">
                <button type="button" onClick={() => input.current?.click()}>Choose a file</button>
                {files.length === 0 && <button type="button" onClick={() => void take()}>Try a sample</button>}
                <span>or drop one anywhere on the page: columns, rows, CGATS, JCAMP-DX, JSON</span>
                <input ref={input} type="file" multiple class="hidden" aria-label="measured file" tabIndex={-1}
                    onChange={(event) => {
                        const target = event.target as HTMLInputElement;
                        void read(target.files).then(() => { target.value = ""; });
                    }} />
            </div>
            {files.map((file) => <FileCard names={names} file={file} replace={(by) => replace(file, by)} />)}
        </section>
    );
}

function FileCard({names, file, replace}: {names: string[]; file: OpenFile; replace: (by: OpenFile[]) => void}) {
    const stated = file.statements.map((statement) => inWordsStated(statement, names));
    const isShared = new Set(stated).size === 1;
    const source = visible(file.source);
    const toggle = (i: number) => {
        const shown = new Set(file.visible);
        if (!shown.delete(i)) shown.add(i);
        replace([{...file, visible: shown}]);
    };
    return (
        <article class="file">
            <h3>{source}</h3>
            <p class="hint">{visible(`${file.format}; ${file.unit_rule}`)}</p>
            {isShared && <p class="hint stated">{stated[0] ? `States: ${stated[0]}.` : "Says nothing of how it was measured; the settings under “measurement” hold."}</p>}
            <ul class="spectra">
                {file.measured.map((spectrum, i) => (
                    <li>
                        <label>
                            <input type="checkbox" checked={file.visible.has(i)} onChange={() => toggle(i)} /> {visible(spectrum.name)}
                            {!isShared && <span class="hint"> {stated[i]}</span>}
                        </label>
                    </li>
                ))}
            </ul>
            {file.findings.length > 0 && (
                <details open={file.findings.some((each) => each.severity === "warning")}>
                    <summary>{counted(file.findings.length, "finding")}</summary>
                    <ul>
                        {file.findings.map((each) => (
                            <li class={each.severity}><strong>{visible(`${each.spectrum}: ${each.message}`)}</strong> {visible(each.remedy)}</li>
                        ))}
                    </ul>
                </details>
            )}
            <button type="button" onClick={() => replace([])}>Remove {source}</button>
        </article>
    );
}
