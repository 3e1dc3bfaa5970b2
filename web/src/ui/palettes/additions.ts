/* SPDX-License-Identifier: MIT */
/* What can be added to a scene: every node type, and the models and distance functions of the
 * document. Shared by both palettes. */
import { type Addition, typeNaming } from "../../model/add.ts";
import { pathTo, type SceneDocument } from "../../model/document.ts";
import type { EntryRow } from "../../model/libraryEntries.ts";
import { isContainer, SOLID_MAKERS } from "../../model/placing.ts";
import type { NodeType, Schema } from "../../model/schema.ts";
import { search } from "../../model/search.ts";
import { modelsFor } from "../../model/usage.ts";
import { typeTitle } from "../names.ts";
import { type TextKey, t } from "../texts.ts";

export interface Offer extends Addition {
    title: string;
    group: string;
    doc: string;
    words: string;
    /* Of the library; absent: of the registry or the document. */
    entry?: EntryRow;
}

function ofType(row: NodeType): Offer {
    const { type, group, doc, words } = row;
    return { type, title: typeTitle(type), group, doc, words };
}

/* An instance of something of the document; `kind` is the type's words too. */
function ofDocument(row: NodeType, group: "models" | "primitives", names: readonly string[]) {
    return names.map(
        (named): Offer => ({
            type: row.type,
            named,
            title: named,
            group,
            doc: t(`${group}.offer`),
            words: `${row.type} ${row.words}`,
        }),
    );
}

/* In groups that follow each other. A type that only names something of the document is offered by
 * what it can name. */
export function offersOf(schema: Schema, document: SceneDocument): readonly Offer[] {
    const [model, field] = [typeNaming(schema, "model"), typeNaming(schema, "function")];
    const types = schema.nodes.filter((row) => row !== model).map(ofType);
    const names = (list: "models" | "primitives") => document[list].map(({ name }) => name);
    return [
        ...types,
        ...(model ? ofDocument(model, "models", names("models")) : []),
        ...(field ? ofDocument(field, "primitives", names("primitives")) : []),
    ];
}

/* What the library has. */
export function libraryOffers(entries: readonly EntryRow[]): readonly Offer[] {
    return entries.map((entry) => ({
        type: "library",
        named: entry.id,
        title: entry.name,
        group: "library",
        doc: t(`library.offer.${entry.kind}`),
        words: entry.kind,
        entry,
    }));
}

/* Only what can go around others. */
export function wrappersOf(schema: Schema): readonly Offer[] {
    return schema.nodes.filter((row) => isContainer(row) && row.group !== "primitive").map(ofType);
}

/* What can be an input of a node: no model that would come to hold itself, and below what makes
 * solids of flat shapes no solid. */
export function inputsOf(
    schema: Schema,
    document: SceneDocument,
    into: string,
    offers: readonly Offer[],
): readonly Offer[] {
    const flat = pathTo(document, into).some(({ type }) => SOLID_MAKERS.includes(type));
    const models = modelsFor(schema, document, into);
    return offers.filter(
        ({ group, named, entry }) =>
            !(flat && group === "primitive") &&
            entry?.kind !== "material" &&
            (group !== "models" || models.includes(named ?? "")),
    );
}

export function searchOffers(offers: readonly Offer[], query: string): readonly Offer[] {
    return search(offers, query, ({ title, group, doc, words }) => ({
        name: title,
        kind: groupTitle(group),
        doc,
        words,
    }));
}

export function groupTitle(group: string): string {
    return t(`group.${group}` as TextKey);
}
