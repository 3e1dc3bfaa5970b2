/* SPDX-License-Identifier: MIT */
/* What people do with the library: save, take, rename, delete, export, import. What it holds is read
 * anew after each change. */
import { download } from "../../link/rest.ts";
import { perform } from "../../model/actions.ts";
import type { Resource, SceneDocument } from "../../model/document.ts";
import {
    entryOfNode,
    entryOfResource,
    renameEntry,
    type Target,
    takeEntry,
} from "../../model/library.ts";
import type { Entry, EntryRow } from "../../model/libraryEntries.ts";
import type { SavedList } from "../../model/places.ts";
import { addNotice } from "../../model/stores.ts";
import type { Editor } from "../editor.ts";
import { chooseFiles, report, SCENE_FILES } from "../files.ts";
import { readFiles } from "../import.ts";
import { sceneKept } from "../opening.ts";
import { t } from "../texts.ts";

type Act = () => Promise<unknown>;

/* Reads what is there. */
export async function refreshLibrary({ rest, stores }: Editor): Promise<void> {
    const rows = await rest.library.list();
    const entries = [...rows].sort((a, b) => a.name.localeCompare(b.name, "en"));
    stores.library.setState({ entries });
}

/* What goes wrong is said. */
async function attempt(editor: Editor, act: Act): Promise<void> {
    try {
        await act();
    } catch (error) {
        report(editor, error);
    }
}

async function change(editor: Editor, act: Act): Promise<void> {
    await attempt(editor, async () => {
        await act();
        await refreshLibrary(editor);
    });
}

function tell(editor: Editor, message: string, back?: () => void): void {
    addNotice(editor.stores.notices, {
        level: "info",
        code: "library",
        message,
        acts: back ? [{ kind: "back", run: back }] : [],
    });
}

/* --- giving --- */

function save(editor: Editor, entry: Entry | null): void {
    void change(editor, async () => {
        const row = entry && (await editor.rest.library.add(entry));
        if (row) {
            const undo = (): void => {
                void change(editor, () => editor.rest.library.delete(row.id));
            };
            tell(editor, t("library.saved", { name: row.name }), undo);
        }
    });
}

export function saveNode(editor: Editor, id: string): void {
    const { document, schema } = editor.stores.document.getState();
    save(editor, document && entryOfNode(schema, document, id));
}

/* A node of a document that is no scene's, under this name. */
export function saveNodeOf(
    editor: Editor,
    document: SceneDocument,
    id: string,
    name: string,
): void {
    const entry = entryOfNode(editor.stores.document.getState().schema, document, id);
    save(editor, entry && renameEntry(entry, name));
}

export function saveResource(editor: Editor, list: SavedList, resource: Resource): void {
    const { document, schema } = editor.stores.document.getState();
    save(editor, document && entryOfResource(schema, document, list, resource));
}

/* --- taking --- */

export function take(editor: Editor, { id }: EntryRow, where: Partial<Target> = {}): void {
    const isKept = sceneKept(editor);
    void attempt(editor, async () => {
        const entry = await editor.rest.library.read(id);
        if (!isKept()) {
            return;
        }
        const { document, schema } = editor.stores.document.getState();
        const { selection, preferences } = editor.stores.view.getState();
        const target = { selection, way: preferences.way, ...where };
        const edit = document && takeEntry(schema, document, entry, target);
        if (edit && perform(editor, edit)) {
            if (entry.kind === "material" && !where.use && selection.length === 0) {
                const name = edit.label.replace(/^add /, "");
                editor.show({ kind: "resource", list: "materials", name });
            }
        }
    });
}

/* --- changing --- */

export function rename(editor: Editor, { id }: EntryRow, name: string): void {
    void change(editor, async () => {
        const entry = await editor.rest.library.read(id);
        await editor.rest.library.put(id, renameEntry(entry, name));
    });
}

export function remove(editor: Editor, { id, name }: EntryRow): void {
    const { library } = editor.rest;
    void change(editor, async () => {
        const entry = await library.read(id);
        await library.delete(id);
        const undo = (): void => {
            void change(editor, () => library.put(id, entry));
        };
        tell(editor, t("library.deleted", { name }), undo);
    });
}

/* --- files --- */

export function exportLibrary(editor: Editor): void {
    void attempt(editor, async () =>
        download(t("library.file"), "json", await editor.rest.library.exportFile()),
    );
}

export function importLibrary(editor: Editor): void {
    chooseFiles(SCENE_FILES, async (files) => {
        for (const { text } of (await readFiles(editor, files)) ?? []) {
            void change(editor, async () => {
                const { added, rows } = await editor.rest.library.importFile(text);
                const known = rows.length - added;
                const more = known > 0 ? ` ${t("library.known", { count: known })}` : "";
                tell(editor, t("library.imported", { count: added }) + more);
            });
        }
    });
}
