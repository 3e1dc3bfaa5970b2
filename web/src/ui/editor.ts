/* SPDX-License-Identifier: MIT */
/* The page's one set of stores, link and REST, and what commands may ask of the page. */
import { takeAuthor, tellLeaving } from "../link/author.ts";
import { createLink, type Link } from "../link/link.ts";
import { createRest, type Rest, takeToken } from "../link/rest.ts";
import type { App } from "../model/actions.ts";
import { createStores, type Stores } from "../model/stores.ts";
import type { Subject } from "../model/view.ts";
import { EDITOR_FILES, takeFiles } from "./drop/take.ts";
import { chooseFiles, SCENE_FILES, saveDocument } from "./files.ts";
import { openFiles, readFiles } from "./import.ts";
import { Opener } from "./opening.ts";

export interface Editor extends App {
    readonly stores: Stores;
    readonly link: Link;
    readonly rest: Rest;
    /* Opens a scene of the server; null closes the one that is open. */
    open(scene: string | null): void;
    /* Tries to connect at once instead of waiting for the next attempt. */
    retry(): void;
    /* What the inspector shows. */
    show(subject: Subject): void;
    /* The picture's element, for its size; null where there is none. */
    setPicture(element: HTMLElement | null): void;
}

export function createEditor(): Editor {
    const token = takeToken(window.location, window.sessionStorage);
    const rest = createRest("", token);
    const stores = createStores(window.localStorage);
    const link = createLink(stores, { base: "", token });
    const author = takeAuthor(window.localStorage, window.sessionStorage, navigator.locks);
    tellLeaving(window, window.sessionStorage);
    const opener = new Opener({ stores, link, rest }, author);
    let picture: HTMLElement | null = null;
    const editor: Editor = {
        stores,
        link,
        rest,
        edit: (ops, options) => link.edit(ops, options),
        undo: () => link.undo(),
        redo: () => link.redo(),
        aspect: () => (picture ? picture.clientWidth / Math.max(1, picture.clientHeight) : 1.5),
        bounds: (nodes) => link.bounds(nodes),
        writeClipboard,
        readClipboard,
        download: () => void saveDocument(editor),
        upload: (folder = false) => upload(editor, folder),
        saveToLibrary: (node) =>
            void import("./library/actions.ts").then(({ saveNode }) => saveNode(editor, node)),
        open: (scene) => void opener.open(scene),
        retry: () => opener.retry(),
        show: (subject) =>
            stores.view.setState(
                subject.kind === "nodes" ? { subject } : { subject, selection: [] },
            ),
        setPicture: (element) => {
            picture = element;
        },
    };
    return editor;
}

/* Where a browser gives no clipboard, without HTTPS for one, all tabs have this one. */
const COPIED = "fieldcast.clipboard";

function writeClipboard(text: string): void {
    const keep = (): void => window.localStorage.setItem(COPIED, text);
    if (navigator.clipboard) {
        navigator.clipboard.writeText(text).catch(keep);
    } else {
        keep();
    }
}

async function readClipboard(): Promise<string> {
    const kept = window.localStorage.getItem(COPIED) ?? "";
    return navigator.clipboard?.readText ? navigator.clipboard.readText().catch(() => kept) : kept;
}

/* On the start page there is no scene to put anything into. */
function upload(editor: Editor, folder: boolean): void {
    const inScene = editor.stores.document.getState().document !== null;
    const accept = inScene ? EDITOR_FILES : SCENE_FILES;
    chooseFiles(folder ? "folder" : accept, async (files) => {
        if (inScene && !folder) {
            await takeFiles(editor, files);
        } else {
            await openFiles(editor, await readFiles(editor, files));
        }
    });
}
