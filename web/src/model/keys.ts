/* SPDX-License-Identifier: MIT */
/* Key names as the command table writes them ("Ctrl+Shift+Z") and as events say them. */

/* What a keyboard event says; the DOM's KeyboardEvent fits. */
export interface KeyPress {
    readonly key: string;
    readonly code: string;
    readonly ctrlKey: boolean;
    readonly metaKey: boolean;
    readonly shiftKey: boolean;
    readonly altKey: boolean;
}

const NAMED: Record<string, string> = {
    " ": "Space",
    ArrowUp: "Up",
    ArrowDown: "Down",
    ArrowLeft: "Left",
    ArrowRight: "Right",
    Escape: "Esc",
};

/* Without Alt a sign such as ? or + is its own name, whatever keys make it. */
function signOf(press: KeyPress): string | null {
    const single = !press.altKey && [...press.key].length === 1;
    return single && !/[a-z0-9 ]/i.test(press.key) ? press.key : null;
}

/* Letters and digits by position only where modifiers change the character (Alt on a Mac). */
function baseOf(press: KeyPress): string {
    if (press.code.startsWith("Numpad") && /^Numpad[0-9]$/.test(press.code)) {
        return `Num${press.code.slice(6)}`;
    }
    const placed = /^(?:Key|Digit)([A-Z0-9])$/.exec(press.code)?.[1];
    if (placed && press.altKey) {
        return placed;
    }
    const name = NAMED[press.key] ?? press.key;
    return name.length === 1 ? name.toUpperCase() : name;
}

/* "Ctrl+Shift+Z" for a key press; Cmd counts as Ctrl. */
export function nameOfPress(press: KeyPress): string {
    const ctrl = press.ctrlKey || press.metaKey;
    const sign = signOf(press);
    const parts = [
        ctrl ? "Ctrl" : "",
        press.altKey ? "Alt" : "",
        /* Shift is part of a sign already. */
        press.shiftKey && sign === null ? "Shift" : "",
        sign ?? baseOf(press),
    ];
    return parts.filter(Boolean).join("+");
}

/* A key that is typed when a text field has the focus. */
export function isSingleKey(keys: string): boolean {
    return !/^(Ctrl|Alt)\+/.test(keys) && !/^(F\d+|Esc|Delete|Backspace|Enter|Home)$/.test(keys);
}
