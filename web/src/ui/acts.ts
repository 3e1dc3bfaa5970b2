/* SPDX-License-Identifier: MIT */
/* What people do with materials, lights and new nodes, as one edit each. Acts on selected nodes
 * are commands (model/commands.ts). */

import { perform } from "../model/commands.ts";
import {
    findResource,
    freeName,
    ID_PATTERN,
    type ListName,
    materialUsers,
    printResource,
    type Resource,
} from "../model/document.ts";
import { addNode as buildNode } from "../model/edits.ts";
import type { JsonObject } from "../model/json.ts";
import type { Operation } from "../model/operations.ts";
import { setPreferences } from "../model/stores.ts";
import type { Editor } from "./editor.ts";
import { t } from "./texts.ts";

const MOST_RECENT = 8;

export function addNode(editor: Editor, type: string): void {
    const { stores } = editor;
    const { document, schema } = stores.document.getState();
    const { selection, preferences } = stores.view.getState();
    if (document && perform(editor, buildNode(document, schema, type, selection))) {
        const others = preferences.recent.filter((old) => old !== type);
        setPreferences(stores.view, { recent: [type, ...others].slice(0, MOST_RECENT) });
    }
}

function insertResource(
    list: ListName,
    name: string,
    value: JsonObject,
    before: string | null,
): Operation {
    return list === "lights"
        ? { op: "insert", into: "/lights", before, value: { ...value, id: name } }
        : { op: "insert", into: "/materials", before, name, value };
}

/* A new material, given to `node` where one is named. */
export function addMaterial(editor: Editor, node: string | null): void {
    const { document, schema } = editor.stores.document.getState();
    const shader = schema.shaders[0]?.type;
    if (document === null || shader === undefined) {
        return;
    }
    const name = freeName(document, "materials", "material");
    const ops = [insertResource("materials", name, { shader, properties: {} }, null)];
    if (node !== null) {
        ops.push({ op: "set", at: `/nodes/${node}/material`, value: name });
    }
    if (editor.link.edit(ops, { label: t("edit.add", { name }) }) && node === null) {
        editor.show({ kind: "material", name });
    }
}

/* A copy of a shared material, for one node alone. */
export function makeMaterialUnique(editor: Editor, node: string, name: string): void {
    const { document } = editor.stores.document.getState();
    const material = document && findResource(document, "materials", name);
    if (document && material) {
        const copy = freeName(document, "materials", name);
        const ops: Operation[] = [
            insertResource("materials", copy, printResource("materials", material), null),
            { op: "set", at: `/nodes/${node}/material`, value: copy },
        ];
        editor.link.edit(ops, { label: t("edit.unique", { name }) });
    }
}

export function addLight(editor: Editor, type: string): void {
    const { document } = editor.stores.document.getState();
    if (document === null) {
        return;
    }
    const name = freeName(document, "lights", type);
    const ops = [insertResource("lights", name, { type }, null)];
    if (editor.link.edit(ops, { label: t("edit.add", { name }) })) {
        editor.show({ kind: "light", name });
    }
}

const kinds = { lights: "light", materials: "material" } as const;

export function duplicateResource(editor: Editor, list: ListName, resource: Resource): void {
    const { document } = editor.stores.document.getState();
    if (document === null) {
        return;
    }
    const name = freeName(document, list, resource.name);
    const at = document[list].findIndex((one) => one.name === resource.name);
    const before = document[list][at + 1]?.name ?? null;
    const ops = [insertResource(list, name, printResource(list, resource), before)];
    if (editor.link.edit(ops, { label: t("edit.duplicate", { name: resource.name }) })) {
        editor.show({ kind: kinds[list], name });
    }
}

/* Nodes that use a material that goes take what their parents have. */
export function removeResource(editor: Editor, list: ListName, name: string): void {
    const { document } = editor.stores.document.getState();
    if (document === null) {
        return;
    }
    const users = list === "materials" ? materialUsers(document, name) : [];
    const ops: Operation[] = [
        ...users.map((id): Operation => ({ op: "set", at: `/nodes/${id}/material`, value: null })),
        { op: "remove", at: `/${list}/${name}` },
    ];
    if (editor.link.edit(ops, { label: t("edit.remove", { name }) })) {
        editor.show({ kind: "nodes" });
    }
}

/* Why a resource cannot have this name, or null. */
export function whyNotName(editor: Editor, list: ListName, name: string): string | null {
    const { document } = editor.stores.document.getState();
    if (!ID_PATTERN.test(name)) {
        return t("name.pattern");
    }
    return document && findResource(document, list, name) ? t("name.taken", { name }) : null;
}

/* A name is an id here: the resource is put in again under the new one and its users follow. */
export function renameResource(editor: Editor, list: ListName, resource: Resource, name: string) {
    const { document } = editor.stores.document.getState();
    if (document === null) {
        return;
    }
    const users = list === "materials" ? materialUsers(document, resource.name) : [];
    const ops: Operation[] = [
        insertResource(list, name, printResource(list, resource), resource.name),
        ...users.map((id): Operation => ({ op: "set", at: `/nodes/${id}/material`, value: name })),
        { op: "remove", at: `/${list}/${resource.name}` },
    ];
    if (editor.link.edit(ops, { label: t("edit.rename", { name: resource.name }) })) {
        editor.show({ kind: kinds[list], name });
    }
}
