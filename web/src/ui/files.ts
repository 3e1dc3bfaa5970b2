/* SPDX-License-Identifier: MIT */
/* Scenes as files: down as JSON or a picture, up by a chooser or a drop. */
import { download, RestError, upload } from "../link/rest.ts";
import { printDocument } from "../model/document.ts";
import { addNotice } from "../model/stores.ts";
import type { Editor } from "./editor.ts";
import { goTo } from "./route.ts";
import { t } from "./texts.ts";

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

export function chooseFile(onFile: (file: File) => void): void {
    const input = window.document.createElement("input");
    input.type = "file";
    input.accept = ".json,application/json";
    input.addEventListener("change", () => {
        const file = input.files?.[0];
        if (file) {
            onFile(file);
        }
    });
    input.click();
}

/* Makes a scene of a file and opens it. */
export async function uploadFile(editor: Editor, file: File): Promise<void> {
    try {
        goTo(await editor.rest.createScene(await upload(file)));
    } catch (error) {
        report(editor, error, t("files.refused", { name: file.name }));
    }
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
