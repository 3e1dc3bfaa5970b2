/* SPDX-License-Identifier: MIT */
/* Files and folders dropped anywhere on the page; answers whether some hover now. What takes files
 * itself has `data-takes-files`. */
import { useEffect, useRef, useState } from "react";
import type { Editor } from "../editor.ts";
import { type PageFile, pathOf, tellFiles, tellUnread } from "../files.ts";
import { useEditor } from "../state.ts";
import { t } from "../texts.ts";

/* More files than this are no folder of a scene. */
const MOST_FILES = 500;

const takesItself = ({ target }: DragEvent): boolean =>
    target instanceof Element && target.closest("[data-takes-files]") !== null;

const holdsFile = ({ dataTransfer }: DragEvent): boolean =>
    dataTransfer?.types.includes("Files") ?? false;

export function useDrop(onFiles: (files: readonly PageFile[]) => void): boolean {
    const editor = useEditor();
    const [hovering, setHovering] = useState(false);
    const latest = useRef(onFiles);
    latest.current = onFiles;
    useEffect(() => {
        const listening = new AbortController();
        /* Before an editor of text, which would type the file. */
        const options = { signal: listening.signal, capture: true };
        window.addEventListener(
            "dragover",
            (event) => {
                if (holdsFile(event)) {
                    event.preventDefault();
                    setHovering(!takesItself(event));
                }
            },
            options,
        );
        window.addEventListener(
            "dragleave",
            (event) => event.relatedTarget === null && setHovering(false),
            options,
        );
        window.addEventListener(
            "drop",
            (event) => {
                setHovering(false);
                if (event.dataTransfer && holdsFile(event) && !takesItself(event)) {
                    event.preventDefault();
                    event.stopPropagation();
                    void dropped(editor, event.dataTransfer).then(
                        (files) => files && latest.current(files),
                    );
                }
            },
            options,
        );
        return () => listening.abort();
    }, [editor]);
    return hovering;
}

/* What a drop holds has to be asked for at once; folders are read afterwards. Null: it was said that
 * something could not be read. */
async function dropped(editor: Editor, data: DataTransfer): Promise<readonly PageFile[] | null> {
    const entries = [...data.items].map((item) => item.webkitGetAsEntry?.() ?? null);
    const files = [...data.files];
    if (!entries.some((entry) => entry?.isDirectory)) {
        return files.map(pathOf);
    }
    const found: Found = { files: [], unread: [], more: false };
    for (const entry of entries) {
        if (entry) {
            await collect(entry, found);
        }
    }
    if (found.more) {
        tellFiles(editor, t("drop.most", { count: MOST_FILES }));
    }
    return tellUnread(editor, found.unread) ? null : found.files;
}

interface Found {
    readonly files: PageFile[];
    /* Paths of what the browser could not read. */
    readonly unread: string[];
    /* There are more files than are taken. */
    more: boolean;
}

const innerPath = ({ fullPath }: FileSystemEntry): string => fullPath.replace(/^\//, "");

async function collect(entry: FileSystemEntry, found: Found): Promise<void> {
    if (found.more || entry.name.startsWith(".")) {
        return;
    }
    try {
        if (entry.isDirectory) {
            await collectFolder(entry as FileSystemDirectoryEntry, found);
        } else if (/\.json$/i.test(entry.name)) {
            await collectFile(entry as FileSystemFileEntry, found);
        }
    } catch {
        found.unread.push(innerPath(entry));
    }
}

async function collectFile(entry: FileSystemFileEntry, found: Found): Promise<void> {
    found.more = found.files.length === MOST_FILES;
    if (!found.more) {
        const file = await new Promise<File>((take, fail) => entry.file(take, fail));
        found.files.push({ path: innerPath(entry), file });
    }
}

async function collectFolder(entry: FileSystemDirectoryEntry, found: Found): Promise<void> {
    const reader = entry.createReader();
    /* A folder is read in pieces, until a piece is empty. */
    for (;;) {
        const piece = await new Promise<FileSystemEntry[]>((take, fail) =>
            reader.readEntries(take, fail),
        );
        if (piece.length === 0) {
            return;
        }
        for (const inner of piece) {
            await collect(inner, found);
        }
    }
}
