import type {JSX} from "preact";
import {useState} from "preact/hooks";

type FieldProps = Omit<JSX.InputHTMLAttributes<HTMLInputElement>, "value" | "onInput" | "onChange" | "onBlur"> & {
    value: string;
    settle: (text: string, event: Event) => void;
};

/// A field that one types into. Until it is left, or Enter pressed, it shows what was typed, whatever is drawn anew
/// meanwhile: an answer of the server must not wipe out half a number.
export function Field({value, settle, ...rest}: FieldProps) {
    const [draft, setDraft] = useState<string>();
    const text = (event: Event) => (event.target as HTMLInputElement).value;
    return (
        <input {...rest} value={draft ?? value}
            onInput={(event) => setDraft(text(event))}
            onChange={(event) => { setDraft(undefined); settle(text(event), event); }}
            onBlur={() => setDraft(undefined)} />
    );
}
