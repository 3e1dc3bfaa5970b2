/* SPDX-License-Identifier: MIT */
/* How components reach the stores and the acts: hooks with selectors, so that each renders only
 * for what it shows. */
import { createContext, useContext } from "react";
import { useStore } from "zustand";
import type { DocumentState, LibraryState, LinkState, NoticeState } from "../model/stores.ts";
import type { View } from "../model/view.ts";
import type { Editor } from "./editor.ts";

export const EditorContext = createContext<Editor | null>(null);

export function useEditor(): Editor {
    const editor = useContext(EditorContext);
    if (editor === null) {
        throw new Error("no editor around this component");
    }
    return editor;
}

export function useDocument<T>(selector: (state: DocumentState) => T): T {
    return useStore(useEditor().stores.document, selector);
}

export function useView<T>(selector: (state: View) => T): T {
    return useStore(useEditor().stores.view, selector);
}

export function useLink<T>(selector: (state: LinkState) => T): T {
    return useStore(useEditor().stores.link, selector);
}

export function useNotices<T>(selector: (state: NoticeState) => T): T {
    return useStore(useEditor().stores.notices, selector);
}

export function useLibrary<T>(selector: (state: LibraryState) => T): T {
    return useStore(useEditor().stores.library, selector);
}
