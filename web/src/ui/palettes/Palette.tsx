/* SPDX-License-Identifier: MIT */
/* What palettes have in common: a dialog with a search field over groups of options, all by keys.
 * A palette says what its options are, how one looks, and what taking it does. */
import { type ReactNode, useEffect, useMemo, useRef, useState } from "react";
import { t } from "../texts.ts";
import { Dialog } from "../widgets/Dialog.tsx";
import { takeKept } from "./ahead.ts";
import { useListbox } from "./listbox.ts";
import { Foot, Search } from "./Search.tsx";
import "./palettes.css";

export interface Group<T> {
    title: string;
    items: readonly T[];
}

export interface Face {
    /* Names it among all options. */
    key: string;
    className: string;
    content: ReactNode;
    tip?: string;
    disabled?: boolean;
    /* It can be dragged elsewhere. */
    onDragStart?: (event: React.DragEvent) => void;
    /* What tests find it by. */
    data: Readonly<Record<`data-${string}`, string>>;
}

export interface PaletteProps<T> {
    title: string;
    placeholder: string;
    /* Laid out in columns; else one below the other. */
    grid?: boolean;
    find: (query: string) => readonly Group<T>[];
    faceOf: (item: T) => Face;
    footOf?: (item: T) => ReactNode;
    onTake: (item: T) => void;
    /* The one that Enter would take. */
    onActive?: (item: T | null) => void;
}

interface DialogProps<T> extends PaletteProps<T> {
    open: boolean;
    onClose: () => void;
}

export function Palette<T>({ open, onClose, ...props }: DialogProps<T>) {
    const field = useRef<HTMLInputElement>(null);
    return (
        <Dialog
            open={open}
            title={props.title}
            bare
            wide={props.grid}
            first={field}
            closeLabel={t("close")}
            onClose={onClose}
        >
            <PaletteBody {...props} field={field} onClose={onClose} />
        </Dialog>
    );
}

interface BodyProps<T> extends PaletteProps<T> {
    field: React.RefObject<HTMLInputElement | null>;
    onClose: () => void;
}

export function PaletteBody<T>(props: BodyProps<T>) {
    const { field, title, placeholder, grid, find, faceOf, footOf, onTake, onActive, onClose } =
        props;
    const [query, setQuery] = useState("");
    const groups = useMemo(() => find(query), [find, query]);
    const all = groups.flatMap((group) => group.items);
    const take = (index: number): void => {
        const item = all[index];
        if (item !== undefined) {
            onClose();
            onTake(item);
        }
    };
    const box = useListbox(all.length, query, take);
    /* What was typed before the field had the focus; Enter then takes the first match. */
    const [early, setEarly] = useState(false);
    useEffect(
        () =>
            takeKept((key) => {
                if (key === "Enter") {
                    setEarly(true);
                } else {
                    setQuery((old) => (key === "Backspace" ? old.slice(0, -1) : old + key));
                }
            }),
        [],
    );
    const takeFirst = useRef(take);
    takeFirst.current = take;
    useEffect(() => {
        if (early) {
            takeFirst.current(0);
        }
    }, [early]);
    const active = all[box.active];
    useEffect(() => onActive?.(active ?? null), [active, onActive]);
    let index = -1;
    return (
        <>
            <Search
                ref={field}
                label={title}
                placeholder={placeholder}
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
                data-grid={grid ? "" : undefined}
                aria-label={title}
                tabIndex={-1}
            >
                {groups
                    .filter(({ items }) => items.length > 0)
                    .map((group) => (
                        // biome-ignore lint/a11y/useSemanticElements: a fieldset cannot hold options
                        <div key={group.title} role="group" aria-label={group.title}>
                            <div className="palette-group" aria-hidden="true">
                                {group.title}
                            </div>
                            <div className={grid ? "tile-grid" : undefined} role="presentation">
                                {group.items.map((item) => {
                                    index += 1;
                                    const here = index;
                                    const face = faceOf(item);
                                    return (
                                        // biome-ignore lint/a11y/useKeyWithClickEvents: the search field has the focus and the keys
                                        <div
                                            key={face.key}
                                            id={box.optionId(here)}
                                            className={face.className}
                                            role="option"
                                            tabIndex={-1}
                                            aria-selected={here === box.active}
                                            aria-disabled={face.disabled || undefined}
                                            title={face.tip}
                                            {...face.data}
                                            draggable={face.onDragStart !== undefined}
                                            onDragStart={face.onDragStart}
                                            onPointerMove={() => box.hover(here)}
                                            onClick={() => take(here)}
                                        >
                                            {face.content}
                                        </div>
                                    );
                                })}
                            </div>
                        </div>
                    ))}
            </div>
            {all.length === 0 && <p className="empty-note">{t("palette.nothing", { query })}</p>}
            <Foot drags={active !== undefined && faceOf(active).onDragStart !== undefined}>
                {active !== undefined && footOf?.(active)}
            </Foot>
        </>
    );
}
