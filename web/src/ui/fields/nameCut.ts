/* SPDX-License-Identifier: MIT */
/* As `maxLength` of an input, but in the bytes that the server counts. */
import { bytesOf } from "../../model/jsonText.ts";
import { limitOf } from "../../model/schema.ts";
import { cutToBytes } from "../../model/values.ts";
import { useDocument } from "../state.ts";

/* Takes back what was typed or pasted before the cursor beyond `most` bytes; answers what is left. */
export function cutInput(input: HTMLInputElement, most: number): string {
    const { value } = input;
    const at = input.selectionStart ?? value.length;
    const after = value.slice(at);
    const before = cutToBytes(value.slice(0, at), most - bytesOf(after));
    if (before.length < at) {
        input.value = before + after;
        input.setSelectionRange(before.length, before.length);
    }
    return input.value;
}

/* The same for the name of something. */
export function useNameCut(): (input: HTMLInputElement) => string {
    const most = useDocument(({ schema }) => limitOf(schema, "name_bytes", 200));
    return (input) => cutInput(input, most);
}
