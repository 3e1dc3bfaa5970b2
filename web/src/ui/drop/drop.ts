/* SPDX-License-Identifier: MIT */
/* Files and folders dropped anywhere on the page; answers whether some hover now. What takes files
 * itself has `data-takes-files`. */
import { useEffect, useRef, useState } from "react";

/* More files than this are no folder of a scene. */
const MOST_FILES = 500;

/* A file by its path inside of what was chosen or dropped. */
export interface PageFile {
    readonly path: string;
    readonly file: File;
}

export const pathOf = (file: File): PageFile => ({
    path: file.webkitRelativePath || file.name,
    file,
});

const takesItself = ({ target }: DragEvent): boolean =>
    target instanceof Element && target.closest("[data-takes-files]") !== null;

const holdsFile = ({ dataTransfer }: DragEvent): boolean =>
    dataTransfer?.types.includes("Files") ?? false;

export function useDrop(onFiles: (files: readonly PageFile[]) => void): boolean {
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
                    void dropped(event.dataTransfer).then((files) => latest.current(files));
                }
            },
            options,
        );
        return () => listening.abort();
    }, []);
    return hovering;
}

/* What a drop holds has to be asked for at once; folders are read afterwards. */
async function dropped(data: DataTransfer): Promise<readonly PageFile[]> {
    const entries = [...data.items].map((item) => item.webkitGetAsEntry?.() ?? null);
    const files = [...data.files];
    if (!entries.some((entry) => entry?.isDirectory)) {
        return files.map(pathOf);
    }
    const found: PageFile[] = [];
    for (const entry of entries) {
        if (entry) {
            await collect(entry, found);
        }
    }
    return found;
}

async function collect(entry: FileSystemEntry, found: PageFile[]): Promise<void> {
    if (found.length >= MOST_FILES || entry.name.startsWith(".")) {
        return;
    }
    if (entry.isFile) {
        const file = await new Promise<File>((take, fail) =>
            (entry as FileSystemFileEntry).file(take, fail),
        );
        if (/\.json$/i.test(file.name)) {
            found.push({ path: entry.fullPath.replace(/^\//, ""), file });
        }
        return;
    }
    const reader = (entry as FileSystemDirectoryEntry).createReader();
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
