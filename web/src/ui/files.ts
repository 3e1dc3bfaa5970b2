/* SPDX-License-Identifier: MIT */
/* Scenes as files: down as JSON, up by a chooser; import.ts makes scenes of them. */
import { download, RestError } from "../link/rest.ts";
import { printDocument } from "../model/documentJson.ts";
import type { Json } from "../model/json.ts";
import { printText } from "../model/jsonText.ts";
import { addNotice } from "../model/stores.ts";
import type { Editor } from "./editor.ts";
import { t } from "./texts.ts";

/* A file by its path inside of what was chosen or dropped. */
export interface PageFile {
    readonly path: string;
    readonly file: File;
}

export const pathOf = (file: File): PageFile => ({
    path: file.webkitRelativePath || file.name,
    file,
});

/* The server's own bytes where it can be reached, else what this page holds. */
export async function saveDocument(editor: Editor): Promise<void> {
    const { scene, document } = editor.stores.document.getState();
    if (scene === null || document === null) {
        return;
    }
    const json = await editor.rest.readScene(scene).catch(() => printDocument(document));
    downloadJson(String(document.info.name ?? scene), json);
}

export function downloadJson(name: string, json: Json): void {
    const blob = new Blob([printText(json)], { type: "application/json" });
    download(name, "json", blob);
}

export const SCENE_FILES = ".json,application/json";

/* Opens the chooser for files that `accept` names, or for a folder. */
export function chooseFiles(
    accept: string | "folder",
    onFiles: (files: readonly PageFile[]) => void,
): void {
    const input = window.document.createElement("input");
    input.type = "file";
    input.multiple = true;
    input.webkitdirectory = accept === "folder";
    if (accept !== "folder") {
        input.accept = accept;
    }
    input.addEventListener("change", () => {
        const files = [...(input.files ?? [])].map(pathOf);
        if (files.length > 0) {
            onFiles(files);
        }
    });
    input.click();
}

/* Says what went wrong with a request. */
export function report(editor: Editor, error: unknown, before = ""): void {
    const rest = error instanceof RestError ? error : null;
    const message = error instanceof Error ? error.message : String(error);
    addNotice(editor.stores.notices, {
        level: "error",
        code: rest?.code ?? "syntax",
        message: before === "" ? message : `${before} ${message}`,
        place: rest?.place ?? "",
    });
}

const MOST_NAMES = 3;

/* The first names of files. */
export function fewNames(paths: readonly string[]): string {
    const more = paths.length > MOST_NAMES ? ", …" : "";
    return paths.slice(0, MOST_NAMES).join(", ") + more;
}

export function tellFiles(editor: Editor, message: string): void {
    addNotice(editor.stores.notices, { level: "warning", code: "files", message });
}

/* Says which files could not be read; false: all could. */
export function tellUnread(editor: Editor, paths: readonly string[]): boolean {
    if (paths.length > 0) {
        tellFiles(editor, t("files.unread", { names: fewNames(paths) }));
    }
    return paths.length > 0;
}
