/* SPDX-License-Identifier: MIT */
/* What of the document the tree shows, so that a dragged number does not render it anew. */
import { useRef } from "react";
import type { SceneDocument } from "../../model/document.ts";
import { useDocument } from "../state.ts";

/* The document as far as the tree shows it: the same one while only numbers change. */
export function useTreeDocument(): SceneDocument | null {
    const last = useRef<SceneDocument | null>(null);
    return useDocument(({ document }) => {
        if (last.current === null || document === null || !sameTree(last.current, document)) {
            last.current = document;
        }
        return last.current;
    });
}

function sameTree(a: SceneDocument, b: SceneDocument): boolean {
    if (a.nodes.size !== b.nodes.size || a.root !== b.root) {
        return false;
    }
    for (const [id, node] of b.nodes) {
        const old = a.nodes.get(id);
        const same =
            old === node ||
            (old?.type === node.type &&
                old.common === node.common &&
                old.parent === node.parent &&
                old.children === node.children);
        if (!same) {
            return false;
        }
    }
    return true;
}
