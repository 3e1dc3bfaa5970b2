/* SPDX-License-Identifier: MIT */
/* Which nodes a filter leaves in the tree: those whose name or type fits, and what holds them. */
import { nodeLabel, pathTo, type SceneDocument } from "../../model/document.ts";

export function filterNodes(document: SceneDocument, query: string): ReadonlySet<string> | null {
    const word = query.trim().toLowerCase();
    if (word === "") {
        return null;
    }
    const kept = new Set<string>();
    for (const node of document.nodes.values()) {
        const model = document.models.find(({ root }) => root === node.id)?.name ?? "";
        const text = `${nodeLabel(node)} ${node.id} ${node.type.replaceAll("_", " ")} ${model}`;
        if (text.toLowerCase().includes(word)) {
            for (const above of pathTo(document, node.id)) {
                kept.add(above.id);
            }
        }
    }
    return kept;
}
