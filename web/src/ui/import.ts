/* SPDX-License-Identifier: MIT */
/* Files that are chosen or dropped become scenes: documents of ours one each, files of the other
 * format, which name each other, one together. */
import { RestError } from "../link/rest.ts";
import { addNotice } from "../model/stores.ts";
import type { Editor } from "./editor.ts";
import { type PageFile, report, tellUnread } from "./files.ts";
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
    /* Scenes of which one has to be named, and the files to choose them from. */
    readonly choices: readonly string[];
    readonly files: readonly TextFile[];
}

const READ = /\.(json|txt|glsl|hlsl|slang)$/i;
const AROUND = 2;
const MOST_NOTES = 2;

/* Null: one could not be read, since it is gone or protected. That was said. */
export async function readFiles(
    editor: Editor,
    files: readonly PageFile[],
): Promise<readonly TextFile[] | null> {
    const wanted = files.filter(({ path }) => READ.test(path) || files.length === 1);
    const unread: string[] = [];
    const texts: TextFile[] = [];
    for (const { path, file } of wanted) {
        await file.text().then(
            (text) => texts.push({ path, text }),
            () => unread.push(path),
        );
    }
    return tellUnread(editor, unread) ? null : texts;
}

/* A document of ours, also a broken one. */
export function isDocument({ text }: TextFile): boolean {
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
    const place = rest?.place ?? "";
    const named = files.find(({ path }) => place === path || place.startsWith(`${path}/`));
    const file = named ?? (files.length === 1 ? files[0] : undefined);
    const inside = named ? place.slice(named.path.length) : place;
    const line = rest?.line ?? null;
    const message = error instanceof Error ? error.message : String(error);
    const lines = file && line !== null ? file.text.split("\n") : [];
    const from = Math.max(1, (line ?? 1) - AROUND);
    return {
        file: file?.path ?? "",
        message: inside === "" ? message : `${inside}: ${message}`,
        line,
        column: rest?.column ?? null,
        excerpt: lines.slice(from - 1, (line ?? 0) + AROUND),
        from,
        choices: [],
        files,
    };
}

/* Names of the scenes among files of the other format. */
function scenesIn(files: readonly TextFile[]): string[] {
    return files
        .filter(({ text }) => /"scene"\s*:/.test(text))
        .map(({ path }) => path.replace(/^.*\//, "").replace(/\.json$/i, ""));
}

async function importFiles(editor: Editor, files: readonly TextFile[], scene: string | null) {
    const texts = Object.fromEntries(files.map(({ path, text }) => [path, text]));
    const { id, notes } = await editor.rest.importScene(texts, scene);
    const { notices } = editor.stores;
    for (const message of notes.slice(0, MOST_NOTES)) {
        addNotice(notices, { level: "info", code: "import", message });
    }
    if (notes.length > MOST_NOTES) {
        const message = t("import.notes", { count: notes.length - MOST_NOTES });
        addNotice(notices, { level: "info", code: "import", message });
    }
    return id;
}

/* Makes scenes of files and opens the last one. A problem is shown on the start page, else told.
 * `files` null: it was said already that they cannot be read. `scene`: which, where files of the other
 * format hold several. */
export async function openFiles(
    editor: Editor,
    files: readonly TextFile[] | null,
    onProblem?: (problem: ImportProblem) => void,
    scene: string | null = null,
): Promise<void> {
    if (files === null) {
        return;
    }
    if (files.length === 0) {
        report(editor, new Error(t("import.nothing")));
        return;
    }
    const ours = files.filter(isDocument);
    const others = withoutFolder(files.filter((file) => !isDocument(file)));
    let asked = ours;
    try {
        let made: string | null = null;
        for (const file of ours) {
            asked = [file];
            made = await editor.rest.createFromText(file.text);
        }
        if (others.length > 0) {
            asked = [...others];
            made = await importFiles(editor, others, scene);
        }
        goTo(made);
    } catch (error) {
        if (onProblem && error instanceof RestError && error.status !== 0) {
            const names = error.place === "" && scene === null ? scenesIn(asked) : [];
            const choices = names.length > 1 ? names : [];
            onProblem({ ...problemOf(error, asked), choices, files: asked });
        } else {
            report(editor, error, t("files.refused", { name: asked[0]?.path ?? "" }));
        }
    }
}
