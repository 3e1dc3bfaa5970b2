/* SPDX-License-Identifier: MIT */
/* What people do with new nodes, resources and code, as one edit each. Acts on selected nodes are
 * commands (model/commands.ts). */

import { extentOf, perform, selectionOf, tellDeleted } from "../model/actions.ts";
import {
    type Addition,
    addInput as buildInput,
    addNode as buildNode,
    typeNaming,
} from "../model/add.ts";
import { findResource, paramAt, type Resource, type SceneDocument } from "../model/document.ts";
import type { Edit } from "../model/edits.ts";
import { newLight } from "../model/lights.ts";
import { ID_PATTERN, type ListName, nodeOfPlace, resourceOfPlace } from "../model/places.ts";
import type { Preset } from "../model/presets.ts";
import {
    duplicateResource,
    newMaterialOf,
    newResource,
    newTyped,
    type ResourceEdit,
    removeResource,
    renameResource,
    uniqueMaterial,
} from "../model/resources.ts";
import { type Schema, shaderType } from "../model/schema.ts";
import { setPreferences } from "../model/stores.ts";
import type { Editor } from "./editor.ts";
import { t } from "./texts.ts";

const MOST_RECENT = 8;

/* Puts a type in front of those that were last added. */
export function remember({ stores }: Editor, type: string): void {
    const { recent } = stores.view.getState().preferences;
    const others = recent.filter((old) => old !== type);
    setPreferences(stores.view, { recent: [type, ...others].slice(0, MOST_RECENT) });
}

/* Sends an edit that adds something, and remembers what. */
export function performAdding(
    editor: Editor,
    { type }: Addition,
    build: (document: SceneDocument, schema: Schema) => Edit,
): void {
    const { stores } = editor;
    const { document, schema } = stores.document.getState();
    if (document && perform(editor, build(document, schema))) {
        remember(editor, type);
    }
}

export function addNode(editor: Editor, addition: Addition): void {
    const { selection, preferences } = editor.stores.view.getState();
    performAdding(editor, addition, (document, schema) =>
        buildNode(document, schema, addition, selection, preferences.way),
    );
}

/* As the last input of `into`. */
export function addInput(editor: Editor, addition: Addition, into: string): void {
    performAdding(editor, addition, (document, schema) =>
        buildInput(document, schema, addition, into),
    );
}

export function selectNode(editor: Editor, id: string): void {
    editor.stores.view.setState({ selection: [id], subject: { kind: "nodes" } });
}

/* --- code --- */

export function openCode(editor: Editor, place: string): void {
    editor.stores.view.setState({ code: place, drawer: "code" });
}

/* Shows whatever a place lies in, and the code there, if there is some. */
export function showPlace(editor: Editor, place: string, code: boolean): void {
    const { document, schema } = editor.stores.document.getState();
    const node = nodeOfPlace(place);
    const resource = resourceOfPlace(place);
    if (node !== null) {
        selectNode(editor, node);
    } else if (resource !== null) {
        editor.show({ kind: "resource", ...resource });
    }
    if (code && document && paramAt(schema, document, place)?.param.type === "code") {
        openCode(editor, place);
    }
}

/* The place of the code of a resource, or null where it has none. */
export function codePlace(schema: Schema, list: ListName, name: string): string | null {
    const params =
        list === "primitives" ? schema.primitive : list === "shaders" ? schema.shader : [];
    const code = params.find((param) => param.type === "code");
    return code ? `/${list}/${name}/${code.name}` : null;
}

/* --- resources --- */

/* Sends an edit and shows what it is about. */
function performOn(
    editor: Editor,
    build: (document: SceneDocument, schema: Schema) => ResourceEdit,
    show: (edit: ResourceEdit) => void,
): void {
    const { document, schema } = editor.stores.document.getState();
    const edit = document && build(document, schema);
    if (edit && editor.link.edit(edit.ops, { label: edit.label })) {
        show(edit);
    }
}

const showIt =
    (editor: Editor, list: ListName) =>
    ({ name }: ResourceEdit) =>
        editor.show({ kind: "resource", list, name });

/* A new one; `use` is the place that is to name it. */
export function addResource(
    editor: Editor,
    list: ListName,
    use: string | null,
    preset: Preset | null = null,
): void {
    const { selection, preferences } = editor.stores.view.getState();
    performOn(
        editor,
        (document, schema) =>
            newResource(document, schema, list, use, selection, preferences.way, preset),
        ({ name, select }) => {
            const { schema } = editor.stores.document.getState();
            const code = codePlace(schema, list, name);
            if (list === "models" && use === null) {
                editor.stores.view.setState({ selection: select });
            } else if (use === null || code !== null) {
                editor.show({ kind: "resource", list, name });
            }
            if (code !== null) {
                openCode(editor, code);
            }
        },
    );
}

/* A light or a volume of a type. */
export async function addTyped(editor: Editor, list: ListName, type: string): Promise<void> {
    const lit = list === "lights" ? await extentOf(editor, selectionOf(editor)) : null;
    if (list === "lights" && lit === null) {
        return;
    }
    performOn(
        editor,
        (document, schema) =>
            lit ? newLight(document, schema, type, lit.box) : newTyped(document, list, type),
        showIt(editor, list),
    );
}

/* Something made of it: an instance of a model, a node of a distance function, a material. */
export function addInstance(
    editor: Editor,
    list: "models" | "primitives" | "shaders",
    named: string,
): void {
    if (list === "shaders") {
        const build = (document: SceneDocument) => newMaterialOf(document, named);
        performOn(editor, build, showIt(editor, "materials"));
        return;
    }
    const { schema } = editor.stores.document.getState();
    const row = typeNaming(schema, list === "models" ? "model" : "function");
    if (row) {
        addNode(editor, { type: row.type, named });
    }
}

export function makeMaterialUnique(editor: Editor, node: string, name: string): void {
    const { document } = editor.stores.document.getState();
    const material = document && findResource(document, "materials", name);
    if (material) {
        performOn(
            editor,
            (scene) => uniqueMaterial(scene, node, material),
            () => undefined,
        );
    }
}

export function duplicate(editor: Editor, list: ListName, resource: Resource): void {
    performOn(
        editor,
        (document) => duplicateResource(document, list, resource),
        showIt(editor, list),
    );
}

export function remove(editor: Editor, list: ListName, name: string): void {
    performOn(
        editor,
        (document, schema) => removeResource(document, schema, list, name),
        (edit) => {
            editor.show({ kind: "nodes" });
            tellDeleted(editor, name, edit.label);
        },
    );
}

/* Why a resource cannot have this name, or null. */
export function whyNotName(editor: Editor, list: ListName, name: string): string | null {
    const { document, schema } = editor.stores.document.getState();
    if (!ID_PATTERN.test(name)) {
        return t("name.pattern");
    }
    const builtIn = list === "shaders" && shaderType(schema, name) !== null;
    const taken = document !== null && findResource(document, list, name) !== null;
    return builtIn || taken ? t("name.taken", { name }) : null;
}

export function rename(editor: Editor, list: ListName, resource: Resource, name: string): void {
    const { code } = editor.stores.view.getState();
    performOn(
        editor,
        (document, schema) => renameResource(document, schema, list, resource, name),
        (edit) => {
            showIt(editor, list)(edit);
            const old = `/${list}/${resource.name}/`;
            if (code?.startsWith(old)) {
                openCode(editor, `/${list}/${name}/${code.slice(old.length)}`);
            }
        },
    );
}
