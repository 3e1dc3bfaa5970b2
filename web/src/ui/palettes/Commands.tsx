/* SPDX-License-Identifier: MIT */
/* The command palette: commands, node types to add, nodes by name, scenes. */
import { Box, ChevronRight } from "lucide-react";
import { type ReactNode, useEffect, useMemo, useRef, useState } from "react";
import type { SceneEntry } from "../../link/rest.ts";
import { runCommand, searchCommands } from "../../model/commands.ts";
import { nodeLabel, type SceneDocument } from "../../model/document.ts";
import { nodeType, type Schema, searchNodeTypes } from "../../model/schema.ts";
import { addNotice } from "../../model/stores.ts";
import { addNode } from "../acts.ts";
import type { Editor } from "../editor.ts";
import { keyText } from "../frame/keys.ts";
import { typeTitle } from "../names.ts";
import { Dialog } from "../parts/Dialog.tsx";
import { Glyph } from "../parts/Glyph.tsx";
import { goTo } from "../route.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { useListbox } from "./listbox.ts";
import { Foot, Search } from "./Search.tsx";
import "./palettes.css";

interface Entry {
    id: string;
    group: string;
    title: string;
    note?: string;
    keys?: string;
    icon: ReactNode;
    whyNot?: string | null;
    run: () => void;
}

const MOST_NODES = 12;
const MOST_TYPES = 8;

function commandEntries(editor: Editor, query: string): Entry[] {
    const found = searchCommands(query).map((command) => ({
        id: `command-${command.id}`,
        group: t("commands.commands"),
        title: command.title,
        keys: keyText(command.keys[0]),
        icon: <ChevronRight size={15} aria-hidden="true" />,
        whyNot: command.whyNot(editor),
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

function typeEntries(editor: Editor, schema: Schema, query: string): Entry[] {
    return searchNodeTypes(schema, query)
        .slice(0, MOST_TYPES)
        .map((row) => ({
            id: `add-${row.type}`,
            group: t("commands.add"),
            title: typeTitle(row.type),
            icon: <Glyph type={row.type} group={row.group} />,
            run: () => addNode(editor, row.type),
        }));
}

function nodeEntries(editor: Editor, schema: Schema, document: SceneDocument, query: string) {
    const word = query.trim().toLowerCase();
    return [...document.nodes.values()]
        .filter((node) => `${nodeLabel(node)} ${node.id}`.toLowerCase().includes(word))
        .slice(0, MOST_NODES)
        .map(
            (node): Entry => ({
                id: `node-${node.id}`,
                group: t("commands.nodes"),
                title: nodeLabel(node),
                note: typeTitle(node.type),
                icon: <Glyph type={node.type} group={nodeType(schema, node.type)?.group} />,
                run: () =>
                    editor.stores.view.setState({
                        selection: [node.id],
                        subject: { kind: "nodes" },
                    }),
            }),
        );
}

function sceneEntries(scenes: readonly SceneEntry[], query: string): Entry[] {
    const word = query.trim().toLowerCase();
    return scenes
        .filter(({ id, name }) => `${name} ${id}`.toLowerCase().includes(word))
        .slice(0, MOST_TYPES)
        .map(({ id, name }) => ({
            id: `scene-${id}`,
            group: t("commands.scenes"),
            title: name || id,
            icon: <Box size={15} aria-hidden="true" />,
            run: () => goTo(id),
        }));
}

function useScenes(): readonly SceneEntry[] {
    const { rest } = useEditor();
    const [scenes, setScenes] = useState<readonly SceneEntry[]>([]);
    useEffect(() => {
        let gone = false;
        rest.listScenes().then(
            (list) => gone || setScenes(list),
            () => undefined /* offline: there is nothing to offer */,
        );
        return () => {
            gone = true;
        };
    }, [rest]);
    return scenes;
}

export function CommandPalette() {
    const { stores } = useEditor();
    const open = useView((view) => view.popup === "commands");
    const field = useRef<HTMLInputElement>(null);
    const close = (): void => {
        if (stores.view.getState().popup === "commands") {
            stores.view.setState({ popup: null });
        }
    };
    return (
        <Dialog
            open={open}
            title={t("commands.title")}
            bare
            first={field}
            closeLabel={t("close")}
            onClose={close}
        >
            <Palette field={field} onClose={close} />
        </Dialog>
    );
}

interface PaletteProps {
    field: React.RefObject<HTMLInputElement | null>;
    onClose: () => void;
}

function Palette({ field, onClose }: PaletteProps) {
    const editor = useEditor();
    const document = useDocument((state) => state.document);
    const schema = useDocument((state) => state.schema);
    const scenes = useScenes();
    const [query, setQuery] = useState("");
    const entries = useMemo<Entry[]>(() => {
        const searched = query.trim() !== "";
        const commands = commandEntries(editor, query);
        const types = searched && document ? typeEntries(editor, schema, query) : [];
        const nodes = document ? nodeEntries(editor, schema, document, query) : [];
        const others = sceneEntries(scenes, query);
        return searched
            ? [...types, ...nodes, ...commands, ...others]
            : [...commands, ...nodes, ...others];
    }, [editor, document, schema, scenes, query]);
    const take = (index: number): void => {
        const entry = entries[index];
        if (entry) {
            onClose();
            entry.run();
        }
    };
    const box = useListbox(entries.length, query, take);
    return (
        <>
            <Search
                ref={field}
                label={t("commands.title")}
                placeholder={t("commands.search")}
                value={query}
                listId={box.listId}
                activeId={entries.length > 0 ? box.optionId(box.active) : undefined}
                onChange={setQuery}
                onKeyDown={box.onKeyDown}
            />
            <div
                className="palette-list"
                role="listbox"
                id={box.listId}
                ref={box.list}
                aria-label={t("commands.title")}
                tabIndex={-1}
            >
                {entries.map((entry, index) => (
                    <div key={entry.id} role="presentation">
                        {entry.group !== entries[index - 1]?.group && (
                            <div className="palette-group" role="presentation">
                                {entry.group}
                            </div>
                        )}
                        {/* biome-ignore lint/a11y/useKeyWithClickEvents: the search field has the keys */}
                        <div
                            id={box.optionId(index)}
                            className="command"
                            role="option"
                            tabIndex={-1}
                            aria-selected={index === box.active}
                            aria-disabled={entry.whyNot ? true : undefined}
                            data-entry={entry.id}
                            onPointerMove={() => box.hover(index)}
                            onClick={() => take(index)}
                        >
                            {entry.icon}
                            <span className="command-title ellipsis">{entry.title}</span>
                            {(entry.whyNot ?? entry.note) && (
                                <span className="command-note">{entry.whyNot ?? entry.note}</span>
                            )}
                            {entry.keys && !entry.whyNot && <kbd>{entry.keys}</kbd>}
                        </div>
                    </div>
                ))}
            </div>
            {entries.length === 0 && (
                <p className="empty-note">{t("commands.nothing", { query })}</p>
            )}
            <Foot />
        </>
    );
}
