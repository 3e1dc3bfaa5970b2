/* SPDX-License-Identifier: MIT */
/* Texts of the model and the link that people read, by key. A second language replaces this table. */

const TEXTS = {
    "edit.refused": "Not done: {message}",
    "edit.rejected": "The server refused “{label}”: {message}",
    "edit.unnamed": "edit",
    "undo.skipped": "{count} values were changed by somebody else since and were left as they are.",
    "undo.skippedOne": "Somebody else has changed this since, so it was left as it is.",
    "undo.anywayLabel": "undo over somebody else’s change",
    "link.resync": "This page had fallen out of step and was loaded anew.",
    "why.noScene": "No scene is open.",
    "why.noSelection": "Nothing is selected.",
    "why.onlyRoot": "The root node stays.",
    "why.oneOnly": "Select one node.",
    "why.notMovable": "Nothing is selected that can be moved so.",
    "why.noInstance": "It is no instance of a model.",
    "why.isInstance": "It is an instance already: choose its parameters.",
    "why.twoNeeded": "Select two or more nodes.",
    "why.noParentStep": "It is already the first or last.",
    "why.noChildren": "The node has no children to keep.",
    "why.parked": "It is on the shelf already.",
    "why.notParked": "It is not on the shelf.",
    "why.nothingUndo": "There is nothing of yours to undo.",
    "why.nothingRedo": "There is nothing to redo.",
    "why.allVisible": "Nothing is hidden.",
    "why.clipboard": "The clipboard holds no node.",
    "why.colors": "The colours are shown.",
    "why.noLens": "The camera has no aperture: everything is sharp.",
    "why.held": "Let go first of what is held in the picture, or press Esc.",
    "why.top": "Nothing is open.",
    "picture.noOutput": "Choose an output.",
    "picture.large": "Pictures have {most} million pixels at most.",
    "picture.numbersOnly": "The output {name} has no picture, only numbers: choose NPY.",
    "picture.oneInJpeg": "A JPEG holds one output: choose PNG or NPY for several.",
    "picture.lightAlone": "An HDR holds the light of color alone: choose NPY for other outputs.",
    "picture.opaqueJpeg": "A JPEG cannot be transparent: choose PNG.",
    "snap.floor": "floor",
    "edit.deleted": "{name} deleted.",
    "edit.deletedByOther": "{name} deleted by somebody else.",
    "why.pointerBackspace":
        "Backspace resets the value under the pointer. Delete removes the selected nodes.",
    saved: "Everything is saved, revision {revision}.",
    waiting: "{count} edits are waiting to be sent.",
} as const;

export type TextKey = keyof typeof TEXTS;

/* The text, with {name} filled in. */
export function text(key: TextKey, values: Readonly<Record<string, string | number>> = {}): string {
    return TEXTS[key].replace(/\{(\w+)\}/g, (_, name: string) => String(values[name] ?? ""));
}

export function capitalised(name: string): string {
    return name.charAt(0).toUpperCase() + name.slice(1);
}
