/* SPDX-License-Identifier: MIT */
/* The editor of the text itself, CodeMirror 6. Knows text, faults and marked lines; what they mean
 * is draft.ts's matter. */
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import {
    bracketMatching,
    foldGutter,
    foldKeymap,
    indentUnit,
    syntaxHighlighting,
} from "@codemirror/language";
import { type Diagnostic, lintGutter, setDiagnostics } from "@codemirror/lint";
import {
    EditorSelection,
    EditorState,
    StateEffect,
    StateField,
    Transaction,
} from "@codemirror/state";
import {
    Decoration,
    type DecorationSet,
    EditorView,
    highlightActiveLine,
    highlightActiveLineGutter,
    highlightSpecialChars,
    keymap,
    lineNumbers,
    ViewPlugin,
} from "@codemirror/view";
import type { Span } from "../../model/jsonText.ts";
import { changesBetween } from "../code/change.ts";
import { NARROW } from "../theme.ts";
import { foldBrackets, sceneColours, sceneLanguage } from "./language.ts";

export interface Fault extends Span {
    readonly message: string;
}

export interface TextEditor {
    text(): string;
    /* Replaces what differs; the cursor stays where it is. `undoable`: as if it had been typed. */
    setText(text: string, undoable?: boolean): void;
    setFaults(faults: readonly Fault[]): void;
    /* Marks the lines of these parts; `shown` comes in sight. */
    mark(parts: readonly Span[], shown: Span | null): void;
    /* From 1. */
    lineOf(offset: number): { readonly line: number; readonly column: number };
    goTo(offset: number): void;
    hasFocus(): boolean;
    /* After its room has become less: the cursor is in sight again. */
    keepCursor(): void;
    focus(): void;
    destroy(): void;
}

export interface TextEvents {
    onType(): void;
    onApply(): void;
    onLeave(): void;
    /* A hand has put the cursor somewhere. */
    onCursor(offset: number): void;
}

const INDENT = "  ";

const setMarks = StateEffect.define<readonly Span[]>();
const markedLine = Decoration.line({ class: "text-marked" });

const marks = StateField.define<DecorationSet>({
    create: () => Decoration.none,
    update: (old, { effects, changes, state }) => {
        const effect = effects.find((one) => one.is(setMarks));
        if (!effect) {
            return old.map(changes);
        }
        const starts = new Set<number>();
        for (const { from, to } of effect.value as readonly Span[]) {
            const last = state.doc.lineAt(Math.min(to, state.doc.length)).number;
            for (
                let n = state.doc.lineAt(Math.min(from, state.doc.length)).number;
                n <= last;
                n++
            ) {
                starts.add(state.doc.line(n).from);
            }
        }
        return Decoration.set([...starts].sort((a, b) => a - b).map((at) => markedLine.range(at)));
    },
    provide: (field) => EditorView.decorations.from(field),
});

/* Of a line that is wrapped what follows stands below its text, a step further in. */
function hangingIn({ state, visibleRanges }: EditorView): DecorationSet {
    const found = [];
    for (const { from, to } of visibleRanges) {
        for (let at = from; at <= to; ) {
            const line = state.doc.lineAt(at);
            const indent = line.text.search(/\S|$/) + INDENT.length;
            const style = `text-indent: -${indent}ch; padding-inline-start: calc(${indent}ch + 6px)`;
            found.push(Decoration.line({ attributes: { style } }).range(line.from));
            at = line.to + 1;
        }
    }
    return Decoration.set(found, true);
}

const hanging = ViewPlugin.define(
    (view) => ({
        decorations: hangingIn(view),
        update(update) {
            if (update.docChanged || update.viewportChanged) {
                this.decorations = hangingIn(update.view);
            }
        },
    }),
    { decorations: (plugin) => plugin.decorations },
);

function extensionsOf(label: string, events: TextEvents) {
    return [
        lineNumbers(),
        foldGutter(),
        foldBrackets,
        highlightActiveLine(),
        highlightActiveLineGutter(),
        highlightSpecialChars(),
        lintGutter(),
        history(),
        bracketMatching(),
        EditorState.tabSize.of(INDENT.length),
        indentUnit.of(INDENT),
        sceneLanguage,
        syntaxHighlighting(sceneColours),
        marks,
        EditorView.contentAttributes.of({ "aria-label": label }),
        window.matchMedia(NARROW).matches ? [EditorView.lineWrapping, hanging] : [],
        keymap.of([
            {
                key: "Mod-Enter",
                run: () => {
                    events.onApply();
                    return true;
                },
            },
            ...defaultKeymap,
            ...historyKeymap,
            ...foldKeymap,
            indentWithTab,
        ]),
        EditorView.updateListener.of(({ docChanged, transactions, state, selectionSet }) => {
            const quiet = transactions.some((one) => one.annotation(Transaction.remote));
            if (docChanged && !quiet) {
                events.onType();
            }
            if (selectionSet && transactions.some((one) => one.isUserEvent("select"))) {
                events.onCursor(state.selection.main.head);
            }
        }),
        EditorView.domEventHandlers({ blur: () => events.onLeave() }),
    ];
}

export function mountText(
    parent: HTMLElement,
    text: string,
    label: string,
    events: TextEvents,
): TextEditor {
    const view = new EditorView({ parent, doc: text, extensions: extensionsOf(label, events) });
    const reach = (offset: number): number => Math.min(offset, view.state.doc.length);
    /* All of it, or as much as there is room for from its start. */
    const whole = ({ from, to }: Span) =>
        EditorView.scrollIntoView(EditorSelection.range(reach(to), reach(from)), { yMargin: 24 });
    return {
        text: () => view.state.doc.toString(),
        setText: (next, undoable = false) =>
            view.dispatch({
                changes: [...changesBetween(view.state.doc.toString(), next)],
                annotations: [Transaction.remote.of(true), Transaction.addToHistory.of(undoable)],
            }),
        setFaults: (faults) => {
            const found = faults.map(
                ({ from, to, message }): Diagnostic => ({
                    from: reach(from),
                    to: reach(Math.max(to, from + 1)),
                    severity: "error",
                    message,
                }),
            );
            view.dispatch(setDiagnostics(view.state, found));
        },
        mark: (parts, shown) =>
            view.dispatch({
                effects: [setMarks.of(parts), ...(shown ? [whole(shown)] : [])],
            }),
        lineOf: (offset) => {
            const { number, from } = view.state.doc.lineAt(reach(offset));
            return { line: number, column: reach(offset) - from + 1 };
        },
        goTo: (offset) => {
            view.dispatch({ selection: { anchor: reach(offset) }, scrollIntoView: true });
            view.focus();
        },
        hasFocus: () => view.hasFocus,
        keepCursor: () => {
            if (view.hasFocus) {
                const { head } = view.state.selection.main;
                view.dispatch({ effects: EditorView.scrollIntoView(head, { yMargin: 12 }) });
            }
        },
        focus: () => view.focus(),
        destroy: () => view.destroy(),
    };
}
