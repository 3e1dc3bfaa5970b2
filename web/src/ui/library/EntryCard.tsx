/* SPDX-License-Identifier: MIT */
/* A card of the library: a click adds it to the scene; a menu renames and deletes it. */
import { Ellipsis, Pencil, Plus, Trash2 } from "lucide-react";
import { useState } from "react";
import type { EntryRow } from "../../model/libraryEntries.ts";
import { carryEntry } from "../drop/carry.ts";
import { RenameField } from "../scenes/Card.tsx";
import { useDocument, useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { IconButton } from "../widgets/Button.tsx";
import { Menu, MenuItem, MenuLine } from "../widgets/Menu.tsx";
import { remove, rename, take } from "./actions.ts";
import { EntryPicture } from "./EntryPicture.tsx";

export function EntryCard({ entry }: { entry: EntryRow }) {
    const editor = useEditor();
    const [renaming, setRenaming] = useState(false);
    const able = useDocument(({ document }) => document !== null);
    const { id, name, kind, nodes } = entry;
    const words = t(`library.kind.${kind}`);
    const add = (): void => {
        editor.stores.view.setState({ popup: null });
        take(editor, entry);
    };
    const done = (text: string): void => {
        setRenaming(false);
        if (text !== "" && text !== name) {
            rename(editor, entry, text);
        }
    };
    return (
        <li
            className="card"
            data-entry={id}
            draggable={able}
            onDragStart={(event) => carryEntry(editor, event, entry)}
        >
            <button
                type="button"
                className="card-open"
                aria-label={t("library.add", { name })}
                disabled={!able}
                onClick={add}
            >
                <EntryPicture entry={entry} large />
            </button>
            <div className="card-text">
                {renaming ? (
                    <RenameField name={name} onDone={done} onCancel={() => setRenaming(false)} />
                ) : (
                    <span className="card-name ellipsis" title={name}>
                        {name}
                    </span>
                )}
                <Menu
                    align="end"
                    trigger={
                        <IconButton title={t("scenes.more", { name })} data-size="s">
                            <Ellipsis size={15} />
                        </IconButton>
                    }
                >
                    <MenuItem icon={<Plus size={14} />} disabled={!able} onSelect={add}>
                        {t("reference.add")}
                    </MenuItem>
                    <MenuItem icon={<Pencil size={14} />} onSelect={() => setRenaming(true)}>
                        {t("scenes.rename")}
                    </MenuItem>
                    <MenuLine />
                    <MenuItem
                        icon={<Trash2 size={14} />}
                        danger
                        onSelect={() => remove(editor, entry)}
                    >
                        {t("scenes.delete")}
                    </MenuItem>
                </Menu>
            </div>
            <span className="card-meta">
                {kind === "model" && nodes > 1
                    ? t("library.nodes", { kind: words, count: nodes })
                    : words}
            </span>
        </li>
    );
}
