/* SPDX-License-Identifier: MIT */
/* What a shape does to others, for who asks why something looks as it does. */
import type { SceneDocument, SceneNode } from "./document.ts";

/* It takes away, keeps nothing outside of it, or melts together with what is beside it. */
export type Effect = "cuts" | "limits" | "blends";

const effectIn = (operation: SceneNode, child: string): Effect | null => {
    const { type, children } = operation;
    if (type.endsWith("difference")) {
        return children[0] === child ? null : "cuts";
    }
    if (type.endsWith("intersection")) {
        return children[0] === child ? null : "limits";
    }
    return type === "smooth_union" && children.length > 1 ? "blends" : null;
};

/* Of a shape, or of the nearest above it that has one, and what it is done to; null: none. */
export function effectOf(
    document: SceneDocument,
    id: string,
): { readonly effect: Effect; readonly on: SceneNode } | null {
    for (let node = document.nodes.get(id); node?.parent != null; ) {
        const above = document.nodes.get(node.parent);
        const effect = above ? effectIn(above, node.id) : null;
        const first = document.nodes.get(above?.children[0] ?? "");
        if (above && first && effect !== null) {
            return { effect, on: effect === "blends" ? above : first };
        }
        node = above;
    }
    return null;
}
