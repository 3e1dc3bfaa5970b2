/* SPDX-License-Identifier: MIT */
/* What becomes of files in the editor: a scene is asked about, a picture becomes the environment,
 * files of the other format become a scene. */
import { addNotice } from "../../model/stores.ts";
import type { Editor } from "../editor.ts";
import { fewNames, type PageFile, report, tellFiles } from "../files.ts";
import { type ImportProblem, isDocument, openFiles, readFiles } from "../import.ts";
import { sceneKept } from "../opening.ts";
import { t } from "../texts.ts";

export const EDITOR_FILES = ".json,.hdr,.png,.jpg,.jpeg,application/json,image/png,image/jpeg";

const PICTURE = /\.(hdr|png|jpe?g)$/i;
const JPEG = /\.jpe?g$/i;
const JSON_FILE = /\.(json|txt)$/i;

export async function takeFiles(
    editor: Editor,
    files: readonly PageFile[],
    onProblem?: (problem: ImportProblem) => void,
): Promise<void> {
    const pictures = files.filter(({ path }) => PICTURE.test(path));
    const jsons = files.filter(({ path }) => JSON_FILE.test(path));
    const others = files.filter((file) => !pictures.includes(file) && !jsons.includes(file));
    tellStrange(editor, others);
    const [picture, ...more] = pictures;
    const isKept = sceneKept(editor);
    if (picture) {
        await setEnvironment(editor, picture.file);
    }
    if (!isKept()) {
        return;
    }
    if (more.length > 0) {
        const names = more.map(({ path }) => path).join(", ");
        tellFiles(editor, t("drop.onePicture", { names }));
    }
    const texts = (await readFiles(editor, jsons)) ?? [];
    const scenes = texts.filter(isDocument);
    const rest = texts.filter((text) => !isDocument(text));
    if (scenes.length > 0) {
        editor.stores.view.setState({ offered: scenes });
    }
    if (rest.length > 0 || files.length === 0) {
        await openFiles(editor, rest, onProblem);
    }
}

function tellStrange(editor: Editor, files: readonly PageFile[]): void {
    if (files.length > 0) {
        const names = fewNames(files.map(({ path }) => path));
        tellFiles(editor, t("drop.strange", { names }));
    }
}

/* The server keeps PNG and HDR; what a browser reads besides becomes PNG here. */
async function asAsset(file: File): Promise<Blob> {
    if (!JPEG.test(file.name)) {
        return file;
    }
    const picture = await createImageBitmap(file);
    const canvas = new OffscreenCanvas(picture.width, picture.height);
    canvas.getContext("2d")?.drawImage(picture, 0, 0);
    picture.close();
    return canvas.convertToBlob({ type: "image/png" });
}

async function setEnvironment(editor: Editor, file: File): Promise<void> {
    const label = t("drop.environmentEdit");
    const isKept = sceneKept(editor);
    try {
        const { id } = await editor.rest.uploadAsset(await asAsset(file));
        if (!isKept()) {
            return;
        }
        const set = (name: string, value: string) =>
            ({ op: "set", at: `/environment/${name}`, value }) as const;
        if (editor.link.edit([set("type", "image"), set("image", id)], { label })) {
            editor.show({ kind: "environment" });
            addNotice(editor.stores.notices, {
                level: "info",
                code: "environment",
                message: t("drop.environment", { name: file.name }),
                acts: [{ kind: "undo", label }],
            });
        }
    } catch (error) {
        report(editor, error, t("drop.noPicture", { name: file.name }));
    }
}
