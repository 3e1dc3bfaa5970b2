/* SPDX-License-Identifier: MIT */
/* Files and folders dropped anywhere on the page; answers whether some hover now. */
import { useEffect, useRef, useState } from "react";
import { readFiles, type TextFile } from "../import.ts";

/* More files than this are no folder of a scene. */
const MOST_FILES = 500;

export function useDrop(onFiles: (files: readonly TextFile[]) => void): boolean {
    const [hovering, setHovering] = useState(false);
    const latest = useRef(onFiles);
    latest.current = onFiles;
    useEffect(() => {
        const listening = new AbortController();
        const options = { signal: listening.signal };
        const holdsFile = (event: DragEvent): boolean =>
            event.dataTransfer?.types.includes("Files") ?? false;
        window.addEventListener(
            "dragover",
            (event) => {
                if (holdsFile(event)) {
                    event.preventDefault();
                    setHovering(true);
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
                if (event.dataTransfer && holdsFile(event)) {
                    event.preventDefault();
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
async function dropped(data: DataTransfer): Promise<readonly TextFile[]> {
    const entries = [...data.items].map((item) => item.webkitGetAsEntry?.() ?? null);
    const files = [...data.files];
    if (!entries.some((entry) => entry?.isDirectory)) {
        return readFiles(files);
    }
    const found: TextFile[] = [];
    for (const entry of entries) {
        if (entry) {
            await collect(entry, found);
        }
    }
    return found;
}

async function collect(entry: FileSystemEntry, found: TextFile[]): Promise<void> {
    if (found.length >= MOST_FILES || entry.name.startsWith(".")) {
        return;
    }
    if (entry.isFile) {
        const file = await new Promise<File>((take, fail) =>
            (entry as FileSystemFileEntry).file(take, fail),
        );
        if (/\.json$/i.test(file.name)) {
            found.push({ path: entry.fullPath.replace(/^\//, ""), text: await file.text() });
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
