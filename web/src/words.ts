// Words of files and links, which anybody may have written.

const short: {[character: string]: string} = {"\n": "\\n", "\r": "\\r", "\t": "\\t"};

/// `text` with all that is not to be seen, or moves what is, written out: control characters, line ends, marks of
/// direction, characters of no width; as the program itself writes them.
export const visible = (text: string): string => text.replace(/[\p{C}\p{Zl}\p{Zp}]/gu, (character) => {
    const code = character.codePointAt(0)!;
    const digits = code.toString(16);
    return short[character] ?? (code < 0x80 ? `\\x${digits.padStart(2, "0")}` : `\\u${digits.padStart(4, "0")}`);
});

/// The same as there is room for it.
export function shortened(name: string, most = 36): string {
    const seen = visible(name);
    return seen.length <= most ? seen : `${seen.slice(0, most - 1)}…`;
}

/// "a", "a and b", "a, b and c".
export const listed = (names: string[]): string =>
    names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`;
