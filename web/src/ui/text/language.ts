/* SPDX-License-Identifier: MIT */
/* Colours of a scene's text, and what of it folds. */
import { foldService, HighlightStyle, StreamLanguage } from "@codemirror/language";
import { tags } from "@lezer/highlight";

export const sceneLanguage = StreamLanguage.define({
    name: "scene",
    token: (stream) => {
        if (stream.eatSpace()) {
            return null;
        }
        if (stream.match(/^"(?:[^"\\]|\\.)*"?/)) {
            return stream.match(/^\s*:/, false) ? "propertyName" : "string";
        }
        if (stream.match(/^-?\d[\d.eE+-]*/)) {
            return "number";
        }
        if (stream.match(/^(true|false|null)\b/)) {
            return "bool";
        }
        stream.next();
        return null;
    },
});

/* The colours stand in code.css. */
export const sceneColours = HighlightStyle.define([
    { tag: tags.propertyName, class: "code-type" },
    { tag: tags.string, class: "code-string" },
    { tag: tags.number, class: "code-number" },
    { tag: tags.bool, class: "code-keyword" },
]);

/* From a bracket at the end of a line to the line that closes it: the next that is no deeper. */
export const foldBrackets = foldService.of((state, from, to) => {
    const line = state.doc.lineAt(from);
    if (!/[[{]\s*$/.test(line.text)) {
        return null;
    }
    const indent = line.text.search(/\S/);
    for (let n = line.number + 1; n <= state.doc.lines; n++) {
        const { text, from: start } = state.doc.line(n);
        const depth = text.search(/\S/);
        if (depth >= 0 && depth <= indent) {
            return { from: to, to: start + depth };
        }
    }
    return null;
});
