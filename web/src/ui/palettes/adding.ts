/* SPDX-License-Identifier: MIT */
/* What is chosen in a palette, put where it can be seen. */
import { extentOf } from "../../model/actions.ts";
import { type Addition, addNode } from "../../model/add.ts";
import { groundIn, seatOf } from "../../model/fitting.ts";
import type { Editor } from "../editor.ts";
import { performAdding } from "../insertions.ts";

export async function addChosen(editor: Editor, addition: Addition): Promise<void> {
    const { stores } = editor;
    const { document, schema } = stores.document.getState();
    const { selection, preferences } = stores.view.getState();
    const { way } = preferences;
    const seat = document && seatOf(document, schema, addition, selection, way);
    /* A guess is no place. */
    const extent = seat && (await extentOf(editor, seat.of));
    const box = extent?.guess === null ? extent.box : null;
    performAdding(editor, addition, (now) => {
        const ground = seat && box && groundIn(now, seat, box);
        return addNode(now, schema, addition, selection, way, ground);
    });
}
