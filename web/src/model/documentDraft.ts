/* SPDX-License-Identifier: MIT */
/* A document under change: what the kinds of operation share. */
import {
    findResource,
    modelOf,
    preorder,
    type Resource,
    type SceneDocument,
    type SceneNode,
} from "./document.ts";
import { readModel, readNode } from "./documentJson.ts";
import type { Json, JsonObject } from "./json.ts";
import { Refusal } from "./operation.ts";
import { LISTS, type ListName } from "./places.ts";
import type { Param, Schema } from "./schema.ts";
import { cycleThrough, listNamedBy } from "./usage.ts";

/* Each part is copied when it is first touched. */
export class DocumentDraft {
    document: SceneDocument;
    readonly schema: Schema;
    readonly #owned: Map<string, SceneNode>;

    constructor(document: SceneDocument, schema: Schema) {
        this.#owned = new Map(document.nodes);
        this.document = { ...document, nodes: this.#owned };
        this.schema = schema;
    }

    /* As it is now. `document` itself goes on changing, so nothing may be remembered of it. */
    snapshot(): SceneDocument {
        return { ...this.document };
    }

    node(id: string, place: string): SceneNode {
        const node = this.#owned.get(id);
        if (!node) {
            throw new Refusal("not_found", place, `there is no node ${id}`);
        }
        return node;
    }

    resource(list: ListName, name: string, place: string): Resource {
        const resource = findResource(this.document, list, name);
        if (!resource) {
            throw new Refusal("not_found", place, `there is no ${LISTS[list].one} ${name}`);
        }
        return resource;
    }

    change(id: string, part: Partial<SceneNode>): void {
        this.#owned.set(id, { ...this.node(id, ""), ...part });
    }

    add(json: JsonObject, parent: string): string {
        return readNode(json, parent, this.#owned);
    }

    addModel(name: string, json: JsonObject): Resource {
        return readModel(name, json, this.#owned);
    }

    drop(id: string): void {
        for (const inner of preorder(this.document, id)) {
            this.#owned.delete(inner);
        }
    }

    setList(list: ListName, resources: readonly Resource[]): void {
        this.document = { ...this.document, [list]: resources };
    }

    /* Refuses where a value names something that is not there. */
    checkName(param: Param, value: Json | undefined, place: string): void {
        const list = listNamedBy(param.type);
        if (list !== null && typeof value === "string" && value !== "") {
            this.resource(list, value, place);
        }
    }

    /* Refuses where the model that holds `id` has come to hold itself. */
    checkCycle(id: string, place: string): void {
        const model = modelOf(this.document, id);
        const cycle = model && cycleThrough(this.schema, this.document, model.name);
        if (cycle) {
            throw new Refusal("conflict", place, `a model would hold itself: ${cycle}`);
        }
    }

    changeResource(list: ListName, name: string, part: Partial<Resource>): void {
        this.setList(
            list,
            this.document[list].map((item) => (item.name === name ? { ...item, ...part } : item)),
        );
    }
}
