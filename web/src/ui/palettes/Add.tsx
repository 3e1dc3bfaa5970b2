/* SPDX-License-Identifier: MIT */
/* Add: everything that a scene can hold, with its picture and a line of help, found by name or
 * synonym. Wrap: the part of it that goes around what is selected. Input: the part that a node can
 * hold, as its last input. */
import { type DragEvent, useCallback, useMemo } from "react";
import { whatAdding } from "../../model/add.ts";
import type { SceneDocument } from "../../model/document.ts";
import { nameAll } from "../../model/edits.ts";
import { isContainer, WAY_NAMES } from "../../model/placing.ts";
import { nodeType } from "../../model/schema.ts";
import { setPreferences } from "../../model/stores.ts";
import { carryOffer } from "../drop/carry.ts";
import { addInput } from "../insertions.ts";
import { take } from "../library/actions.ts";
import { EntryPicture } from "../library/EntryPicture.tsx";
import { useEntries } from "../library/entries.ts";
import { TypeIcon } from "../scene/ResourceIcon.tsx";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { addChosen } from "./adding.ts";
import {
    groupTitle,
    inputsOf,
    libraryOffers,
    type Offer,
    offersOf,
    searchOffers,
    wrappersOf,
} from "./additions.ts";
import { type Face, type Group, Palette } from "./Palette.tsx";
import { TypePicture } from "./TypePicture.tsx";

/* Offers under the titles of their groups. */
function grouped(offers: readonly Offer[]): Group<Offer>[] {
    const groups = [...new Set(offers.map(({ group }) => group))];
    return groups.map((group) => ({
        title: groupTitle(group),
        items: offers.filter((offer) => offer.group === group),
    }));
}

/* The document as far as palettes show it: names that instances can have. */
function useNames(): SceneDocument | null {
    const document = useDocument((state) => state.document);
    const models = useDocument((state) => state.document?.models);
    const primitives = useDocument((state) => state.document?.primitives);
    // biome-ignore lint/correctness/useExhaustiveDependencies: the same one while only numbers change
    return useMemo(() => document, [models, primitives]);
}

export function Add() {
    const editor = useEditor();
    const popup = useView((view) => view.popup);
    const wrapping = popup === "wrap";
    const into = useView((view) => (view.popup === "input" ? view.into : null));
    const open = popup === "add" || wrapping || into !== null;
    const schema = useDocument((state) => state.schema);
    const document = useNames();
    const recent = useView((view) => view.preferences.recent);
    const entries = useEntries(open && !wrapping);
    const find = useCallback(
        (query: string): readonly Group<Offer>[] => {
            if (document === null || !open) {
                return [];
            }
            const all = wrapping
                ? wrappersOf(schema)
                : [...offersOf(schema, document), ...libraryOffers(entries)];
            const offers = into === null ? all : inputsOf(schema, document, into, all);
            if (query.trim() !== "") {
                return [{ title: t("add.results"), items: searchOffers(offers, query) }];
            }
            const last = recent.flatMap((type) =>
                offers.filter((offer) => offer.type === type && offer.named === undefined),
            );
            const groups = grouped(offers);
            return last.length > 0 && !wrapping
                ? [{ title: t("add.recent"), items: last }, ...groups]
                : groups;
        },
        [schema, document, recent, wrapping, into, open, entries],
    );
    const draggable = (offer: Offer): Face => ({
        ...faceOf(offer),
        ...(popup === "add" && {
            onDragStart: (event: DragEvent) => carryOffer(editor, event, offer),
        }),
    });
    const footOf = (offer: Offer) =>
        into === null ? <AddFoot offer={offer} /> : <InputFoot into={into} />;
    return (
        <Palette
            open={open}
            title={t(wrapping ? "wrap.title" : into === null ? "add.title" : "input.title")}
            placeholder={t(wrapping ? "wrap.search" : "add.search")}
            grid
            find={find}
            faceOf={draggable}
            footOf={footOf}
            onTake={(offer) => {
                if (offer.entry) {
                    take(editor, offer.entry, { into });
                } else if (into === null) {
                    addChosen(editor, offer);
                } else {
                    addInput(editor, offer, into);
                }
            }}
            onClose={() => editor.stores.view.setState({ popup: null })}
        />
    );
}

function InputFoot({ into }: { into: string }) {
    const name = useDocument(({ document }) => (document ? nameAll(document, [into]) : ""));
    return <span className="palette-what ellipsis">{t("input.what", { name })}</span>;
}

/* Where it goes, and as what: a choice where there is one. */
function AddFoot({ offer }: { offer: Offer }) {
    const { stores } = useEditor();
    const { document, schema } = stores.document.getState();
    const selection = useView((view) => view.selection);
    const way = useView((view) => view.preferences.way);
    const what = document && whatAdding(document, schema, offer, selection, way);
    const row = nodeType(schema, offer.type);
    const goesAround = row !== null && isContainer(row);
    if (offer.entry?.kind === "material") {
        const words = t(selection.length > 0 ? "library.gives" : "library.brings");
        return <span className="palette-what ellipsis">{words}</span>;
    }
    return (
        <>
            {what?.way !== undefined && !goesAround && (
                // biome-ignore lint/a11y/useSemanticElements: a fieldset brings a look and a legend of its own
                <span className="palette-ways" role="group" aria-label={t("add.as")}>
                    {t("add.as")}
                    {WAY_NAMES.map((one) => (
                        <button
                            key={one}
                            type="button"
                            className="segment"
                            aria-pressed={one === way}
                            data-way={one}
                            /* The search keeps the focus, and Enter its meaning. */
                            onPointerDown={(event) => event.preventDefault()}
                            onClick={() => setPreferences(stores.view, { way: one })}
                        >
                            {t(`way.${one}`)}
                        </button>
                    ))}
                </span>
            )}
            <span className="palette-what ellipsis">{what?.words}</span>
        </>
    );
}

function faceOf(offer: Offer): Face {
    const { type, named, title, doc } = offer;
    return {
        key: named === undefined ? type : `${type}/${named}`,
        className: "tile",
        tip: doc,
        data: { "data-type": type, ...(named === undefined ? {} : { "data-named": named }) },
        content: (
            <>
                <TilePicture offer={offer} />
                <span className="tile-text">
                    <span className="tile-name ellipsis">{title}</span>
                    <span className="tile-doc">{doc}</span>
                </span>
            </>
        ),
    };
}

function TilePicture({ offer: { type, group, named, entry } }: { offer: Offer }) {
    const row = useDocument((state) => nodeType(state.schema, type));
    if (entry) {
        return <EntryPicture entry={entry} />;
    }
    if (named !== undefined) {
        return (
            <span className="type-picture">
                <TypeIcon list={group === "models" ? "models" : "primitives"} size={26} />
            </span>
        );
    }
    return <TypePicture type={type} group={row?.group} />;
}
