/* SPDX-License-Identifier: MIT */
/* What the library has, for those who offer it. */
import { useEffect } from "react";
import type { EntryRow } from "../../model/libraryEntries.ts";
import { useEditor, useLibrary } from "../state.ts";
import { refreshLibrary } from "./actions.ts";

const NONE: readonly EntryRow[] = [];

/* Read anew each time it is shown. Where it cannot be read, the rest is offered. */
export function useEntries(shown: boolean): readonly EntryRow[] {
    const editor = useEditor();
    useEffect(() => {
        if (shown) {
            refreshLibrary(editor).catch(() => undefined);
        }
    }, [editor, shown]);
    return useLibrary((state) => state.entries) ?? NONE;
}
