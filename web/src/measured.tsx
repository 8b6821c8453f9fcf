import {useRef, useState} from "preact/hooks";
import {api} from "./api";
import {counted} from "./scale";
import type {MeasuredFile} from "./types";

/// A file that is shown, and which of its spectra are.
export interface OpenFile extends MeasuredFile {
    visible: Set<number>;
}

export const opened = (file: MeasuredFile): OpenFile => ({...file, visible: new Set(file.measured.length ? [0] : [])});

interface MeasuredProps {
    files: OpenFile[];
    setFiles: (update: (files: OpenFile[]) => OpenFile[]) => void;
    say: (message: string) => void;
    onError: (error: unknown) => void;
}

export function MeasuredFiles({files, setFiles, say, onError}: MeasuredProps) {
    const input = useRef<HTMLInputElement>(null);
    const [isOver, setOver] = useState(false);
    const read = async (chosen: FileList | null | undefined) => {
        for (const file of Array.from(chosen ?? [])) {
            try {
                const found = await api.read(file.name, await file.arrayBuffer());
                setFiles((all) => [...all, opened(found)]);
                say(`${file.name}: ${counted(found.measured.length, "spectrum", "spectra")}, ${counted(found.findings.length, "finding")}`);
            } catch (error) {
                onError(error);
            }
        }
    };
    const replace = (k: number, file: OpenFile) => setFiles((all) => all.map((each, i) => (i === k ? file : each)));
    return (
        <section class="measured" aria-labelledby="measured-title">
            <h2 id="measured-title">Measured spectra</h2>
            <div class={isOver ? "drop over" : "drop"}
                onDragOver={(event) => { event.preventDefault(); setOver(true); }}
                onDragLeave={() => setOver(false)}
                onDrop={(event) => { event.preventDefault(); setOver(false); void read(event.dataTransfer?.files); }}>
                <button type="button" onClick={() => input.current?.click()}>Choose a file</button>
                <span>or drop one here: columns, rows, CGATS, JCAMP-DX, JSON</span>
                <input ref={input} type="file" multiple class="hidden" aria-label="measured file" tabIndex={-1}
                    onChange={(event) => {
                        const target = event.target as HTMLInputElement;
                        void read(target.files).then(() => { target.value = ""; });
                    }} />
            </div>
            {files.map((file, k) => (
                <article class="file">
                    <h3>{file.source}</h3>
                    <p class="hint">{file.format}; {file.unit_rule}</p>
                    <ul class="spectra">
                        {file.measured.map((spectrum, i) => (
                            <li>
                                <label>
                                    <input type="checkbox" checked={file.visible.has(i)} onChange={() => {
                                        const visible = new Set(file.visible);
                                        if (!visible.delete(i)) visible.add(i);
                                        replace(k, {...file, visible});
                                    }} /> {spectrum.name}
                                </label>
                            </li>
                        ))}
                    </ul>
                    {file.findings.length > 0 && (
                        <details open={file.findings.some((each) => each.severity === "warning")}>
                            <summary>{counted(file.findings.length, "finding")}</summary>
                            <ul>
                                {file.findings.map((each) => (
                                    <li class={each.severity}><strong>{each.spectrum}: {each.message}</strong> {each.remedy}</li>
                                ))}
                            </ul>
                        </details>
                    )}
                    <button type="button" onClick={() => setFiles((all) => all.filter((_, i) => i !== k))}>Remove {file.source}</button>
                </article>
            ))}
        </section>
    );
}
