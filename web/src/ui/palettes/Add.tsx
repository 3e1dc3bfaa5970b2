/* SPDX-License-Identifier: MIT */
/* Add: every node type of the schema as a small drawing, found by name or synonym. */
import { useMemo, useRef, useState } from "react";
import { type NodeType, searchNodeTypes } from "../../model/schema.ts";
import { addNode } from "../acts.ts";
import { typeTitle } from "../names.ts";
import { Dialog } from "../parts/Dialog.tsx";
import { Glyph } from "../parts/Glyph.tsx";
import { useDocument, useEditor, useView } from "../state.ts";
import { type TextKey, t } from "../texts.ts";
import { useListbox } from "./listbox.ts";
import { Foot, Search } from "./Search.tsx";
import "./palettes.css";

interface Group {
    title: string;
    rows: readonly NodeType[];
}

export function Add() {
    const { stores } = useEditor();
    const open = useView((view) => view.popup === "add");
    const field = useRef<HTMLInputElement>(null);
    const close = (): void => stores.view.setState({ popup: null });
    return (
        <Dialog
            open={open}
            title={t("add.title")}
            bare
            wide
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
    const schema = useDocument((state) => state.schema);
    const recent = useView((view) => view.preferences.recent);
    const [query, setQuery] = useState("");
    const groups = useMemo<Group[]>(() => {
        const found = searchNodeTypes(schema, query);
        if (query.trim() !== "") {
            return [{ title: t("add.results"), rows: found }];
        }
        const named = [...new Set(found.map((row) => row.group))].map((group) => ({
            title: t(`group.${group}` as TextKey),
            rows: found.filter((row) => row.group === group),
        }));
        const last = recent.flatMap((type) => found.filter((row) => row.type === type));
        return last.length > 0 ? [{ title: t("add.recent"), rows: last }, ...named] : named;
    }, [schema, query, recent]);
    const all = groups.flatMap((group) => group.rows);
    const take = (index: number): void => {
        const row = all[index];
        if (row) {
            onClose();
            addNode(editor, row.type);
        }
    };
    const box = useListbox(all.length, query, take);
    let index = -1;
    return (
        <>
            <Search
                ref={field}
                label={t("add.title")}
                placeholder={t("add.search")}
                value={query}
                listId={box.listId}
                activeId={all.length > 0 ? box.optionId(box.active) : undefined}
                onChange={setQuery}
                onKeyDown={box.onKeyDown}
            />
            <div
                className="palette-list"
                role="listbox"
                id={box.listId}
                ref={box.list}
                data-grid=""
                aria-label={t("add.title")}
                tabIndex={-1}
            >
                {groups.map(({ title, rows }) => (
                    // biome-ignore lint/a11y/useSemanticElements: a fieldset cannot hold options
                    <div key={title} role="group" aria-label={title}>
                        <div className="palette-group" aria-hidden="true">
                            {title}
                        </div>
                        <div className="tile-grid" role="presentation">
                            {rows.map((row) => {
                                index += 1;
                                const here = index;
                                return (
                                    <Tile
                                        key={row.type}
                                        id={box.optionId(here)}
                                        row={row}
                                        active={here === box.active}
                                        onHover={() => box.hover(here)}
                                        onTake={() => take(here)}
                                    />
                                );
                            })}
                        </div>
                    </div>
                ))}
            </div>
            {all.length === 0 && <p className="empty-note">{t("add.nothing", { query })}</p>}
            <Foot>{all[box.active]?.doc}</Foot>
        </>
    );
}

interface TileProps {
    id: string;
    row: NodeType;
    active: boolean;
    onHover: () => void;
    onTake: () => void;
}

function Tile({ id, row, active, onHover, onTake }: TileProps) {
    return (
        // biome-ignore lint/a11y/useKeyWithClickEvents: the search field has the focus and the keys
        <div
            id={id}
            className="tile"
            role="option"
            tabIndex={-1}
            aria-selected={active}
            data-type={row.type}
            title={row.doc}
            onPointerMove={onHover}
            onClick={onTake}
        >
            <Glyph type={row.type} group={row.group} size={34} />
            <span>{typeTitle(row.type)}</span>
        </div>
    );
}
