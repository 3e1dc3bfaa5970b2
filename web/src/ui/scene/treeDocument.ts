/* SPDX-License-Identifier: MIT */
/* What of the document the tree shows, so that a dragged number does not render it anew. */
import { useRef } from "react";
import type { SceneDocument, SceneNode } from "../../model/document.ts";
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

/* What a row says of a node besides its name: the texts among its values. */
function named(node: SceneNode): string {
    return Object.values(node.params)
        .filter((value) => typeof value === "string" && value.length < MOST)
        .join(" ");
}

/* Code is longer, and is not shown. */
const MOST = 65;

function sameTree(a: SceneDocument, b: SceneDocument): boolean {
    if (a.nodes.size !== b.nodes.size || a.root !== b.root || a.models !== b.models) {
        return false;
    }
    for (const [id, node] of b.nodes) {
        const old = a.nodes.get(id);
        const same =
            old === node ||
            (old?.type === node.type &&
                old.common === node.common &&
                named(old) === named(node) &&
                old.parent === node.parent &&
                old.children === node.children);
        if (!same) {
            return false;
        }
    }
    return true;
}
