/* SPDX-License-Identifier: MIT */
/* What the page shows about undo and redo: the labels of this author's steps. The steps
 * themselves are the server's; its counts always win over this memory of their names. */

export interface Step {
    readonly group: string;
    readonly label: string;
    /* What was selected before it. */
    readonly selection: readonly string[];
}

export interface History {
    readonly undo: readonly Step[] /* newest last */;
    readonly redo: readonly Step[];
}

export const EMPTY_HISTORY: History = { undo: [], redo: [] };

/* An edit of ours went out. Same non-empty group as the newest step: the same step. */
export function recordStep(history: History, step: Step): History {
    const newest = history.undo.at(-1);
    if (step.group !== "" && newest?.group === step.group) {
        const joined = { ...newest, label: step.label || newest.label };
        return { undo: [...history.undo.slice(0, -1), joined], redo: [] };
    }
    return { undo: [...history.undo, step], redo: [] };
}

/* An edit group was taken back before anything of it was sent, or was refused. */
export function forgetStep(history: History, group: string): History {
    const newest = history.undo.at(-1);
    return newest?.group === group ? { ...history, undo: history.undo.slice(0, -1) } : history;
}

export function recordUndo(history: History): History {
    const step = history.undo.at(-1);
    return step ? { undo: history.undo.slice(0, -1), redo: [...history.redo, step] } : history;
}

export function recordRedo(history: History): History {
    const step = history.redo.at(-1);
    return step ? { undo: [...history.undo, step], redo: history.redo.slice(0, -1) } : history;
}

const UNNAMED: Step = { group: "", label: "", selection: [] };

function fitSteps(steps: readonly Step[], count: number): readonly Step[] {
    const missing = Math.max(0, count - steps.length);
    return [
        ...new Array<Step>(missing).fill(UNNAMED),
        ...steps.slice(steps.length + missing - count),
    ];
}

/* Fits the names to the server's counts. */
export function fitHistory(history: History, undo: number, redo: number): History {
    if (history.undo.length === undo && history.redo.length === redo) {
        return history;
    }
    return { undo: fitSteps(history.undo, undo), redo: fitSteps(history.redo, redo) };
}

function nameUnnamed(steps: readonly Step[], labels: readonly string[]): readonly Step[] {
    return steps.map((step, i) =>
        step.label === "" ? { ...step, label: labels[steps.length - 1 - i] ?? "" } : step,
    );
}

/* Gives the server's names, newest first, to steps that this page has not made. */
export function nameSteps(
    history: History,
    undo: readonly string[],
    redo: readonly string[],
): History {
    return { undo: nameUnnamed(history.undo, undo), redo: nameUnnamed(history.redo, redo) };
}

/* "Undo move head", or "Undo" where the name is not known. */
export function undoTitle(history: History): string {
    return `Undo ${history.undo.at(-1)?.label ?? ""}`.trim();
}

export function redoTitle(history: History): string {
    return `Redo ${history.redo.at(-1)?.label ?? ""}`.trim();
}
