/* SPDX-License-Identifier: MIT */
/* Ranges of rows: from the row where a selection began, the anchor, to the one that is reached. */
import type { SelectionDataRef, TreeInstance } from "@headless-tree/core";
import type { SceneNode } from "../../model/document.ts";

/* What the tree keeps of a row; the heading of the models is no node. */
export interface TreeItem {
    node: SceneNode | null;
}

type Tree = TreeInstance<TreeItem>;

const memory = (tree: Tree) => tree.getDataRef<SelectionDataRef>().current;

/* A range begins here. */
export function setAnchor(tree: Tree, id: string): void {
    memory(tree).selectUpToAnchorId = id;
}

/* Where a range begins: the anchor while it is selected, else the newest selected row. */
function anchorOf(tree: Tree, fallback: string): string {
    const selected = tree.getState().selectedItems ?? [];
    const anchor = memory(tree).selectUpToAnchorId;
    return anchor != null && selected.includes(anchor) ? anchor : (selected.at(-1) ?? fallback);
}

/* Selects all rows between the anchor and `id`, which becomes the active one. */
export function selectTo(tree: Tree, id: string): void {
    const ids = tree.getItems().map((item) => item.getId());
    const anchor = anchorOf(tree, id);
    const [from, to] = [ids.indexOf(anchor), ids.indexOf(id)];
    if (from < 0 || to < 0) {
        tree.setSelectedItems([id]);
    } else {
        const range = from <= to ? ids.slice(from, to + 1) : ids.slice(to, from + 1).reverse();
        tree.setSelectedItems(range);
    }
    setAnchor(tree, from < 0 ? id : anchor);
}
