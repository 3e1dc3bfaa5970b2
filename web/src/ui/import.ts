/* SPDX-License-Identifier: MIT */
/* Files that are chosen or dropped become scenes: documents of ours one each, files of the other
 * format, which name each other, one together. */
import { RestError } from "../link/rest.ts";
import type { Editor } from "./editor.ts";
import { report } from "./files.ts";
import { goTo } from "./route.ts";
import { t } from "./texts.ts";

/* A text by its path inside of what was chosen. */
export interface TextFile {
    readonly path: string;
    readonly text: string;
}

/* Why files were refused, with the text where it went wrong. */
export interface ImportProblem {
    readonly file: string;
    readonly message: string;
    /* From 1; null: not about a place in the text. */
    readonly line: number | null;
    readonly column: number | null;
    /* Lines around, the first of which is number `from`. */
    readonly excerpt: readonly string[];
    readonly from: number;
}

const READ = /\.(json|txt|glsl|hlsl|slang)$/i;
const AROUND = 2;

export async function readFiles(files: readonly File[]): Promise<TextFile[]> {
    const read = files.filter((file) => READ.test(file.name) || files.length === 1);
    return Promise.all(
        read.map(async (file) => ({
            path: file.webkitRelativePath || file.name,
            text: await file.text(),
        })),
    );
}

/* A document of ours, also a broken one. */
function isDocument({ text }: TextFile): boolean {
    return /"format"\s*:\s*"fieldcast\//.test(text);
}

/* The folder that holds all files is no part of their names. */
export function withoutFolder(files: readonly TextFile[]): readonly TextFile[] {
    const [first] = files[0]?.path.split("/") ?? [];
    const common = files.every(({ path }) => path.startsWith(`${first}/`));
    return common ? files.map((f) => ({ ...f, path: f.path.slice(`${first}/`.length) })) : files;
}

/* Where a refused text went wrong. */
export function problemOf(error: unknown, files: readonly TextFile[]): ImportProblem {
    const rest = error instanceof RestError ? error : null;
    const place = (rest?.place ?? "").replace(/^\/?(files\/)?/, "");
    const file =
        files.find(({ path }) => place === path || place.startsWith(`${path}/`)) ??
        (files.length === 1 ? files[0] : undefined);
    const inside = file && place.startsWith(file.path) ? place.slice(file.path.length) : place;
    const line = rest?.line ?? null;
    const message = error instanceof Error ? error.message : String(error);
    const lines = file && line !== null ? file.text.split("\n") : [];
    const from = Math.max(1, (line ?? 1) - AROUND);
    return {
        file: file?.path ?? place,
        message: inside === "" ? message : `${inside}: ${message}`,
        line,
        column: rest?.column ?? null,
        excerpt: lines.slice(from - 1, (line ?? 0) + AROUND),
        from,
    };
}

/* Makes scenes of files and opens the last one. A problem is shown on the start page, else told. */
export async function openFiles(
    editor: Editor,
    files: readonly TextFile[],
    onProblem?: (problem: ImportProblem) => void,
): Promise<void> {
    if (files.length === 0) {
        const message = t("import.nothing");
        report(editor, new Error(message));
        return;
    }
    const ours = files.filter(isDocument);
    const others = withoutFolder(files.filter((file) => !isDocument(file)));
    let asked = ours;
    try {
        let scene: string | null = null;
        for (const file of ours) {
            asked = [file];
            scene = await editor.rest.createFromText(file.text);
        }
        if (others.length > 0) {
            asked = [...others];
            const texts = Object.fromEntries(others.map(({ path, text }) => [path, text]));
            scene = await editor.rest.importScene(texts, "");
        }
        goTo(scene);
    } catch (error) {
        if (onProblem && error instanceof RestError && error.status !== 0) {
            onProblem(problemOf(error, asked));
        } else {
            report(editor, error, t("files.refused", { name: asked[0]?.path ?? "" }));
        }
    }
}
