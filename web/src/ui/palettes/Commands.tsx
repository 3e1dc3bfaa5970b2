/* SPDX-License-Identifier: MIT */
/* The command palette: commands, what can be added, nodes by name, resources, outputs, scenes. */
import { Bookmark, Box, ChevronRight, Info, Layers2 } from "lucide-react";
import { type ReactNode, useCallback, useEffect, useState } from "react";
import type { SceneEntry } from "../../link/rest.ts";
import { runCommand, searchAbsent, searchCommands, whyNotNow } from "../../model/commandLookup.ts";
import { COMMANDS } from "../../model/commands.ts";
import { nodeLabel, type SceneDocument, typesOf } from "../../model/document.ts";
import { keysOf } from "../../model/keymap.ts";
import type { EntryRow } from "../../model/libraryEntries.ts";
import { LIST_NAMES, LISTS } from "../../model/places.ts";
import { nodeType, outputsShown, type Schema } from "../../model/schema.ts";
import { search } from "../../model/search.ts";
import { addNotice } from "../../model/stores.ts";
import type { Editor } from "../editor.ts";
import { addTyped, selectNode } from "../insertions.ts";
import { keyText } from "../layout/keys.ts";
import { take } from "../library/actions.ts";
import { useEntries } from "../library/entries.ts";
import { outputTitle, paramTitle, typeTitle } from "../names.ts";
import { goTo } from "../route.ts";
import { ResourceIcon, TypeIcon } from "../scene/ResourceIcon.tsx";
import { setups } from "../scene/Resources.tsx";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Glyph } from "../widgets/Glyph.tsx";
import { addChosen } from "./adding.ts";
import { libraryOffers, offersOf, searchOffers } from "./additions.ts";
import { type Face, type Group, Palette } from "./Palette.tsx";

interface Entry {
    id: string;
    title: string;
    note?: string;
    keys?: string;
    icon: ReactNode;
    whyNot?: string | null;
    run: () => void;
}

const MOST_NODES = 12;
const MOST_OTHERS = 8;

function commandEntries(editor: Editor, query: string): Entry[] {
    const { preferences } = editor.stores.view.getState();
    const found = searchCommands(query).map((command) => ({
        id: `command-${command.id}`,
        title: command.title,
        keys: keyText(keysOf(command, COMMANDS, preferences)[0]),
        icon: <ChevronRight size={15} aria-hidden="true" />,
        whyNot: whyNotNow(editor, command),
        run: () => {
            const reason = runCommand(editor, command);
            if (reason !== null) {
                const notice = { level: "info", code: "why", message: reason } as const;
                addNotice(editor.stores.notices, notice);
            }
        },
    }));
    /* What can be done now comes first. */
    return [...found.filter(({ whyNot }) => !whyNot), ...found.filter(({ whyNot }) => whyNot)];
}

/* What there is not, and what there is instead; taking one changes nothing. */
function absentEntries(query: string): Entry[] {
    return searchAbsent(query).map(({ title, answer }) => ({
        id: `absent-${title}`,
        title,
        note: answer,
        icon: <Info size={15} aria-hidden="true" />,
        run: () => undefined,
    }));
}

function offerEntries(
    editor: Editor,
    schema: Schema,
    document: SceneDocument,
    entries: readonly EntryRow[],
    query: string,
) {
    return searchOffers([...offersOf(schema, document), ...libraryOffers(entries)], query)
        .slice(0, MOST_OTHERS)
        .map(
            (offer): Entry => ({
                id: `add-${offer.named ?? offer.type}`,
                title: offer.title,
                ...(offer.entry
                    ? {
                          note: t("library.title"),
                          icon: <Bookmark size={15} aria-hidden="true" />,
                      }
                    : {
                          note: offer.named === undefined ? undefined : typeTitle(offer.type),
                          icon: <Glyph type={offer.type} group={offer.group} />,
                      }),
                run: () => (offer.entry ? take(editor, offer.entry) : addChosen(editor, offer)),
            }),
        );
}

/* Lights and volumes, by their types. */
function typedEntries(editor: Editor, schema: Schema, query: string): Entry[] {
    const all = LIST_NAMES.filter((list) => LISTS[list].id).flatMap((list) =>
        typesOf(schema, list).map(({ type, doc }) => ({
            list,
            type,
            doc,
            name: `${typeTitle(type)} ${LISTS[list].one}`,
        })),
    );
    return search(all, query, ({ name, doc }) => ({ name, doc })).map(({ list, type, name }) => ({
        id: `add-${list}-${type}`,
        title: name,
        icon: <TypeIcon list={list} type={type} />,
        run: () => addTyped(editor, list, type),
    }));
}

function nodeEntries(editor: Editor, schema: Schema, document: SceneDocument, query: string) {
    /* A model is found by its own name. */
    const nodes = [...document.nodes.values()].filter(
        ({ id, parent }) => parent !== null || id === document.root,
    );
    return search(nodes, query, (node) => ({ name: nodeLabel(node), words: node.id }))
        .slice(0, MOST_NODES)
        .map(
            (node): Entry => ({
                id: `node-${node.id}`,
                title: nodeLabel(node),
                note: typeTitle(node.type),
                icon: <Glyph type={node.type} group={nodeType(schema, node.type)?.group} />,
                run: () => selectNode(editor, node.id),
            }),
        );
}

function resourceEntries(editor: Editor, document: SceneDocument, query: string) {
    const all = LIST_NAMES.flatMap((list) => document[list].map(({ name }) => ({ list, name })));
    return search(all, query, ({ list, name }) => ({ name, kind: LISTS[list].one }))
        .slice(0, MOST_OTHERS)
        .map(
            ({ list, name }): Entry => ({
                id: `${list}-${name}`,
                title: name,
                note: typeTitle(LISTS[list].one),
                icon: <ResourceIcon list={list} name={name} />,
                run: () => editor.show({ kind: "resource", list, name }),
            }),
        );
}

/* The camera, the backdrop and the settings of drawing, and what can be set there. */
function setupEntries(editor: Editor, schema: Schema, query: string): Entry[] {
    const all = setups.flatMap(({ kind, title, icon }) => [
        { kind, icon, id: kind, name: t(title), note: undefined, doc: "" },
        ...schema[kind].map((param) => ({
            kind,
            icon,
            id: `${kind}-${param.name}`,
            name: paramTitle(param),
            note: t(title),
            doc: param.doc,
        })),
    ]);
    return search(all, query, ({ name, note = "", doc }) => ({ name, kind: note, doc }))
        .slice(0, MOST_OTHERS)
        .map(({ kind, icon: Icon, id, name, note }) => ({
            id: `setup-${id}`,
            title: name,
            note,
            icon: <Icon size={15} aria-hidden="true" />,
            run: () => editor.show({ kind }),
        }));
}

function outputEntries(editor: Editor, schema: Schema, query: string): Entry[] {
    return search(outputsShown(schema), query, ({ name, doc }) => ({
        name: t("output.show", { name: outputTitle(name) }),
        words: `${name} output`,
        doc,
    })).map(({ name }) => ({
        id: `output-${name}`,
        title: t("output.show", { name: outputTitle(name) }),
        icon: <Layers2 size={15} aria-hidden="true" />,
        run: () => editor.stores.view.setState({ aov: name }),
    }));
}

function sceneEntries(scenes: readonly SceneEntry[], query: string): Entry[] {
    return search(scenes, query, ({ id, name }) => ({ name: name || id, words: id }))
        .slice(0, MOST_OTHERS)
        .map(({ id, name }) => ({
            id: `scene-${id}`,
            title: name || id,
            icon: <Box size={15} aria-hidden="true" />,
            run: () => goTo(id),
        }));
}

function useScenes(open: boolean): readonly SceneEntry[] {
    const { rest } = useEditor();
    const [scenes, setScenes] = useState<readonly SceneEntry[]>([]);
    useEffect(() => {
        let gone = !open;
        if (open) {
            rest.listScenes().then(
                (list) => gone || setScenes(list),
                () => undefined /* offline: there is nothing to offer */,
            );
        }
        return () => {
            gone = true;
        };
    }, [rest, open]);
    return scenes;
}

export function CommandPalette() {
    const editor = useEditor();
    const open = useView((view) => view.popup === "commands");
    const document = useDocument((state) => (open ? state.document : null));
    const schema = useDocument((state) => state.schema);
    const scenes = useScenes(open);
    const entries = useEntries(open);
    const find = useCallback(
        (query: string): readonly Group<Entry>[] => {
            const searched = query.trim() !== "";
            const commands = {
                title: t("commands.commands"),
                items: commandEntries(editor, query),
            };
            const others = { title: t("commands.scenes"), items: sceneEntries(scenes, query) };
            if (document === null) {
                return [commands, others].filter(({ items }) => items.length > 0);
            }
            const nodes = {
                title: t("commands.nodes"),
                items: nodeEntries(editor, schema, document, query),
            };
            const offers = {
                title: t("commands.add"),
                items: searched
                    ? [
                          ...offerEntries(editor, schema, document, entries, query),
                          ...typedEntries(editor, schema, query),
                      ]
                    : [],
            };
            const resources = {
                title: t("commands.resources"),
                items: searched ? resourceEntries(editor, document, query) : [],
            };
            const settings = {
                title: t("setup.title"),
                items: searched ? setupEntries(editor, schema, query) : [],
            };
            const outputs = {
                title: t("commands.outputs"),
                items: searched ? outputEntries(editor, schema, query) : [],
            };
            const absent = { title: t("commands.absent"), items: absentEntries(query) };
            const groups = searched
                ? [offers, nodes, resources, commands, settings, outputs, others, absent]
                : [commands, nodes, others];
            return groups.filter(({ items }) => items.length > 0);
        },
        [editor, document, schema, scenes, entries],
    );
    return (
        <Palette
            open={open}
            title={t("commands.title")}
            placeholder={t("commands.search")}
            find={find}
            faceOf={faceOf}
            onTake={(entry) => entry.run()}
            onClose={() => {
                const { view } = editor.stores;
                if (view.getState().popup === "commands") {
                    view.setState({ popup: null });
                }
            }}
        />
    );
}

function faceOf({ id, icon, title, note, keys, whyNot }: Entry): Face {
    const remark = whyNot ?? note;
    return {
        key: id,
        className: "command",
        disabled: Boolean(whyNot),
        data: { "data-entry": id },
        content: (
            <>
                {icon}
                <span className="command-title ellipsis">{title}</span>
                {remark && <span className="command-note">{remark}</span>}
                {keys && !whyNot && <kbd>{keys}</kbd>}
            </>
        ),
    };
}
