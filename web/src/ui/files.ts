/* SPDX-License-Identifier: MIT */
/* Scenes as files: down as JSON or a picture, up by a chooser; import.ts makes scenes of them. */
import { download, RestError } from "../link/rest.ts";
import { printDocument } from "../model/documentJson.ts";
import { addNotice } from "../model/stores.ts";
import type { Editor } from "./editor.ts";

/* The server's own bytes where it can be reached, else what this page holds. */
export async function saveDocument(editor: Editor): Promise<void> {
    const { scene, document } = editor.stores.document.getState();
    if (scene === null || document === null) {
        return;
    }
    const name = String(document.info.name ?? scene);
    try {
        download(name, await editor.rest.readScene(scene));
    } catch {
        download(name, printDocument(document));
    }
}

const PICTURE_WIDTH = 1920;
const PICTURE_HEIGHT = 1080;

export async function savePicture(editor: Editor): Promise<void> {
    const { scene, document } = editor.stores.document.getState();
    if (scene === null) {
        return;
    }
    try {
        const { camera, own } = editor.stores.camera.getState();
        let url = editor.rest.imageUrl(scene, PICTURE_WIDTH, PICTURE_HEIGHT, "png");
        if (own) {
            url += `&position=${camera.position}&target=${camera.target}&fov=${camera.fov}`;
        }
        const anchor = window.document.createElement("a");
        anchor.href = await editor.rest.fetchImage(url);
        anchor.download = `${String(document?.info.name ?? scene)}.png`;
        anchor.click();
        URL.revokeObjectURL(anchor.href);
    } catch (error) {
        report(editor, error);
    }
}

/* Opens the chooser for files, or for a folder. */
export function chooseFiles(folder: boolean, onFiles: (files: readonly File[]) => void): void {
    const input = window.document.createElement("input");
    input.type = "file";
    input.multiple = true;
    input.webkitdirectory = folder;
    if (!folder) {
        input.accept = ".json,application/json";
    }
    input.addEventListener("change", () => {
        const files = [...(input.files ?? [])];
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
