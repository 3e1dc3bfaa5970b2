/* SPDX-License-Identifier: MIT */
/* The editor of code itself, CodeMirror 6: loaded when code is first opened. Knows text, a mark in
 * it and names to colour; when and where text goes is CodePanel's matter. */
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import {
    bracketMatching,
    indentOnInput,
    indentUnit,
    StreamLanguage,
    syntaxHighlighting,
} from "@codemirror/language";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { Compartment, EditorState, Transaction } from "@codemirror/state";
import {
    EditorView,
    highlightActiveLine,
    highlightActiveLineGutter,
    highlightSpecialChars,
    keymap,
    lineNumbers,
} from "@codemirror/view";
import { changeBetween } from "./change.ts";
import { shaderColours, shaderLanguage } from "./language.ts";

export interface Mark {
    /* From 1. */
    line: number;
    column: number;
    message: string;
}

export interface CodeEditor {
    text(): string;
    /* Replaces what differs; the cursor stays where it is. */
    setText(text: string): void;
    /* In place of everything, as if it had been typed. */
    insert(text: string): void;
    setMark(mark: Mark | null): void;
    /* Names to colour as declared. */
    setNames(names: readonly string[]): void;
    goTo(line: number, column: number): void;
    focus(): void;
    destroy(): void;
}

interface Options {
    text: string;
    label: string;
    onChange: () => void;
    onSend: () => void;
    onLeave: () => void;
}

const TAB = 4;

/* The place of a line and column; the nearest there is. */
function offsetOf(state: EditorState, line: number, column: number): number {
    const row = state.doc.line(Math.min(Math.max(line, 1), state.doc.lines));
    return Math.min(row.from + Math.max(column, 1) - 1, row.to);
}

export function mountCode(parent: HTMLElement, options: Options): CodeEditor {
    let names: ReadonlySet<string> = new Set();
    let silent = false;
    const language = new Compartment();
    const coloured = () => StreamLanguage.define(shaderLanguage(() => names));
    const view = new EditorView({
        parent,
        doc: options.text,
        extensions: [
            lineNumbers(),
            highlightActiveLine(),
            highlightActiveLineGutter(),
            highlightSpecialChars(),
            lintGutter(),
            history(),
            indentOnInput(),
            bracketMatching(),
            EditorState.tabSize.of(TAB),
            indentUnit.of(" ".repeat(TAB)),
            language.of(coloured()),
            syntaxHighlighting(shaderColours),
            EditorView.contentAttributes.of({ "aria-label": options.label }),
            keymap.of([
                {
                    key: "Mod-Enter",
                    run: () => {
                        options.onSend();
                        return true;
                    },
                },
                ...defaultKeymap,
                ...historyKeymap,
                indentWithTab,
            ]),
            EditorView.updateListener.of((update) => {
                if (update.docChanged && !silent) {
                    options.onChange();
                }
            }),
            EditorView.domEventHandlers({ blur: () => options.onLeave() }),
        ],
    });
    return {
        text: () => view.state.doc.toString(),
        setText: (text) => {
            silent = true;
            view.dispatch({
                changes: changeBetween(view.state.doc.toString(), text),
                annotations: Transaction.addToHistory.of(false),
            });
            silent = false;
        },
        insert: (text) => {
            view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } });
        },
        setMark: (mark) => {
            const { state } = view;
            const from = mark ? offsetOf(state, mark.line, mark.column) : 0;
            const word = state.wordAt(from);
            const to = Math.max(word?.to ?? from + 1, from);
            const marks = mark
                ? [
                      {
                          from: Math.min(from, state.doc.length),
                          to: Math.min(to, state.doc.length),
                          severity: "error" as const,
                          message: mark.message,
                      },
                  ]
                : [];
            view.dispatch(setDiagnostics(state, marks));
        },
        setNames: (list) => {
            names = new Set(list);
            view.dispatch({ effects: language.reconfigure(coloured()) });
        },
        goTo: (line, column) => {
            const at = offsetOf(view.state, line, column);
            view.dispatch({ selection: { anchor: at }, scrollIntoView: true });
            view.focus();
        },
        focus: () => view.focus(),
        destroy: () => view.destroy(),
    };
}
