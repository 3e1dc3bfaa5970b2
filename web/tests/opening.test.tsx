/* SPDX-License-Identifier: MIT */
// @vitest-environment jsdom
/* Scenes that are opened and left while the server takes its time. */
import { act } from "react";
import { createRoot } from "react-dom/client";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { Author } from "../src/link/author.ts";
import { RestError } from "../src/link/rest.ts";
import type { Schema } from "../src/model/schema.ts";
import { createStores, EMPTY_DOCUMENT_STATE, IDLE_LINK } from "../src/model/stores.ts";
import { useDrop } from "../src/ui/drop/drop.ts";
import { takeFiles } from "../src/ui/drop/take.ts";
import type { Editor } from "../src/ui/editor.ts";
import AssetField from "../src/ui/fields/Asset.tsx";
import type { PageFile } from "../src/ui/files.ts";
import { take } from "../src/ui/library/actions.ts";
import { Opener } from "../src/ui/opening.ts";
import { EditorContext } from "../src/ui/state.ts";
import { SCHEMA } from "./fixture.ts";

const AUTHOR: Author = { id: "me", key: null, keep: () => undefined, renew: () => undefined };

function setUp(readSchema: () => Promise<Schema>) {
    const stores = createStores(null);
    const connected: string[] = [];
    const link = {
        connect: (scene: string, schema: Schema) => {
            connected.push(scene);
            stores.document.setState({ ...EMPTY_DOCUMENT_STATE, scene, schema });
        },
        disconnect: () => stores.link.setState(IDLE_LINK),
        retry: vi.fn(),
    };
    const opener = new Opener({ stores, link, rest: { readSchema } }, Promise.resolve(AUTHOR));
    return { stores, opener, connected, link };
}

/* Answers in the order of the questions, when the test says so. */
function later<T>() {
    const waiting: ((value: T) => void)[] = [];
    return {
        ask: () => new Promise<T>((resolve) => void waiting.push(resolve)),
        answer: (value: T) => waiting.shift()?.(value),
    };
}

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

const settled = () => vi.advanceTimersByTimeAsync(0);

test("a scene that was left before the schema came is not connected", async () => {
    const schema = later<Schema>();
    const { opener, connected } = setUp(schema.ask);
    void opener.open("a");
    void opener.open(null);
    schema.answer(SCHEMA);
    await settled();
    expect(connected).toEqual([]);
    void opener.open("a");
    void opener.open("b");
    schema.answer(SCHEMA);
    schema.answer(SCHEMA);
    await settled();
    expect(connected).toEqual(["b"]);
});

test("a schema that does not come is told and asked for again", async () => {
    const readSchema = vi.fn<() => Promise<Schema>>();
    readSchema.mockRejectedValue(new RestError(0, "unreachable", "", "no server"));
    const { stores, opener, connected } = setUp(readSchema);
    void opener.open("a");
    await settled();
    expect(stores.link.getState()).toMatchObject({ connection: "offline", reason: "no server" });
    opener.retry();
    await settled();
    expect(readSchema).toHaveBeenCalledTimes(2);
    readSchema.mockResolvedValue(SCHEMA);
    await vi.advanceTimersByTimeAsync(2000);
    expect(connected).toEqual(["a"]);
});

/* A schema that does not come, and the time until it is asked for again. */
function setUpWithout(status: number) {
    const readSchema = vi.fn<() => Promise<Schema>>();
    readSchema.mockRejectedValue(new RestError(status, "other", "", "no"));
    const { stores, ...all } = setUp(readSchema);
    const left = () => (stores.link.getState().retryAt ?? 0) - performance.now();
    return { ...all, readSchema, left };
}

test("a schema is asked for when it is said, and at once when that is asked for", async () => {
    const { opener, readSchema, left } = setUpWithout(0);
    void opener.open("a");
    await settled();
    await vi.advanceTimersByTimeAsync(left() - 1);
    expect(readSchema).toHaveBeenCalledTimes(1);
    await vi.advanceTimersByTimeAsync(1);
    expect(readSchema).toHaveBeenCalledTimes(2);
    /* The time that is not waited for any more ends nothing. */
    const first = left();
    await vi.advanceTimersByTimeAsync(first / 2);
    opener.retry();
    await settled();
    expect(readSchema).toHaveBeenCalledTimes(3);
    await vi.advanceTimersByTimeAsync(first / 2);
    expect(readSchema).toHaveBeenCalledTimes(3);
    opener.retry();
    await settled();
    expect(readSchema).toHaveBeenCalledTimes(4);
});

test("a schema that is refused is asked for again on request alone", async () => {
    const { opener, readSchema } = setUpWithout(401);
    void opener.open("a");
    await vi.advanceTimersByTimeAsync(10_000);
    expect(readSchema).toHaveBeenCalledTimes(1);
    opener.retry();
    await settled();
    expect(readSchema).toHaveBeenCalledTimes(2);
});

test("with the schema a retry is the link's, and no scene asks for the schema again", async () => {
    const { opener, readSchema, connected, link } = setUpWithout(0);
    void opener.open("a");
    await settled();
    readSchema.mockResolvedValue(SCHEMA);
    opener.retry();
    await settled();
    expect(link.retry).not.toHaveBeenCalled();
    opener.retry();
    expect(link.retry).toHaveBeenCalledTimes(1);
    void opener.open("b");
    await settled();
    expect(connected).toEqual(["a", "b"]);
    expect(readSchema).toHaveBeenCalledTimes(2);
});

test("no schema is asked for once its scene was left", async () => {
    const readSchema = vi.fn(() => Promise.reject(new RestError(401, "unauthorized", "", "no")));
    const { stores, opener } = setUp(readSchema);
    void opener.open("a");
    await settled();
    expect(stores.link.getState()).toMatchObject({ connection: "refused", retryAt: null });
    void opener.open(null);
    await vi.advanceTimersByTimeAsync(10_000);
    expect(readSchema).toHaveBeenCalledTimes(1);
    expect(stores.link.getState()).toEqual(IDLE_LINK);
});

/* An editor in scene a, whose server answers when the test says so. */
function editorIn(answers: { ask: () => Promise<unknown> }) {
    const stores = createStores(null);
    stores.document.setState({ scene: "a" });
    const edit = vi.fn(() => true);
    const rest = {
        uploadAsset: answers.ask,
        listAssets: async () => [],
        library: { read: answers.ask },
    };
    const editor = { stores, rest, edit, link: { edit }, show: () => undefined };
    return { editor: editor as unknown as Editor, stores, edit };
}

test.each(["a", "b"])(
    "a picture that is uploaded from a becomes a's environment, in %s",
    async (open) => {
        const answers = later();
        const { editor, stores, edit } = editorIn(answers);
        const taken = takeFiles(editor, [{ path: "x.png", file: new File(["x"], "x.png") }]);
        await settled();
        stores.document.setState({ scene: open });
        answers.answer({ id: "f" });
        await taken;
        expect(edit).toHaveBeenCalledTimes(open === "a" ? 1 : 0);
    },
);

test.each(["a", "b"])("a picture that is dropped on a's field is a's, in %s", async (open) => {
    const answers = later();
    const { editor, stores } = editorIn(answers);
    const onCommit = vi.fn();
    vi.stubGlobal("IS_REACT_ACT_ENVIRONMENT", true);
    const element = document.createElement("div");
    const root = createRoot(element);
    const field = { label: "image", value: "", mixed: false, onCommit, onRefuse: () => undefined };
    await act(async () =>
        root.render(
            <EditorContext value={editor}>
                <AssetField {...(field as unknown as Parameters<typeof AssetField>[0])} />
            </EditorContext>,
        ),
    );
    document.body.append(element);
    const drop = new Event("drop", { bubbles: true });
    Object.assign(drop, { dataTransfer: { files: [new File(["x"], "x.png")] } });
    await act(async () => void element.querySelector(".asset")?.dispatchEvent(drop));
    stores.document.setState({ scene: open });
    await act(async () => void answers.answer({ id: "f" }));
    expect(onCommit.mock.calls).toEqual(open === "a" ? [["f"]] : []);
    await act(async () => root.unmount());
    element.remove();
    vi.unstubAllGlobals();
});

test("an entry of the library that comes late is not put into another scene", async () => {
    const answers = later();
    const { editor, stores } = editorIn(answers);
    take(editor, { id: "e" } as Parameters<typeof take>[1]);
    const reads = vi.spyOn(stores.view, "getState");
    stores.document.setState({ scene: "b" });
    answers.answer({ id: "e" });
    await settled();
    expect(reads).not.toHaveBeenCalled();
});

/* What the page has said of files. */
const said = (editor: Editor): readonly string[] =>
    editor.stores.notices.getState().notices.map(({ message }) => message);

/* jsdom reads no files. */
const HERE = Object.assign(new File([""], "here.json"), {
    text: async () => '{"format": "fieldcast/1"}',
});
const GONE = Object.assign(new File([""], "gone.json"), {
    text: () => Promise.reject(new DOMException("it is gone", "NotFoundError")),
});

test("a file that cannot be read is named, and nothing is opened", async () => {
    const { editor } = editorIn(later());
    await takeFiles(editor, [
        { path: "a/here.json", file: HERE },
        { path: "a/gone.json", file: GONE },
    ]);
    expect(said(editor)).toEqual(["a/gone.json could not be read. Nothing was opened."]);
    expect(editor.stores.view.getState().offered).toEqual([]);
});

/* A folder of the browser, whose files are read in two pieces. */
function folder(files: readonly File[]): DataTransfer {
    const entries = files.map((file) => ({
        ...{ name: file.name, fullPath: `/a/${file.name}`, isFile: true, isDirectory: false },
        file: (take: (file: File) => void, fail: () => void) =>
            file === GONE ? fail() : take(file),
    }));
    const pieces = [entries.slice(0, 2), entries.slice(2), []];
    const readEntries = (take: (piece: unknown) => void) => take(pieces.shift());
    const top = {
        ...{ name: "a", fullPath: "/a", isDirectory: true },
        createReader: () => ({ readEntries }),
    };
    const items = [{ webkitGetAsEntry: () => top }];
    return { items, files: [], types: ["Files"] } as unknown as DataTransfer;
}

function Target({ onFiles }: { onFiles: Parameters<typeof useDrop>[0] }) {
    useDrop(onFiles);
    return null;
}

/* Drops a folder on the page; answers the paths that it takes, null: none. */
async function dropFolder(editor: Editor, files: readonly File[]) {
    let taken: readonly string[] | null = null;
    const onFiles = (found: readonly PageFile[]): void => {
        taken = found.map(({ path }) => path);
    };
    vi.stubGlobal("IS_REACT_ACT_ENVIRONMENT", true);
    const root = createRoot(document.createElement("div"));
    await act(async () =>
        root.render(
            <EditorContext.Provider value={editor}>
                <Target onFiles={onFiles} />
            </EditorContext.Provider>,
        ),
    );
    const drop = Object.assign(new Event("drop"), { dataTransfer: folder(files) });
    await act(async () => void window.dispatchEvent(drop));
    await vi.advanceTimersByTimeAsync(0);
    await act(async () => root.unmount());
    vi.unstubAllGlobals();
    return taken as readonly string[] | null;
}

const jsonFiles = (count: number): File[] =>
    Array.from({ length: count }, (_, i) => new File(["{}"], `${i}.json`));

test("files of a folder that are too many are left out, which is said", async () => {
    const { editor } = editorIn(later());
    const notes = new File([""], "notes.md");
    expect(await dropFolder(editor, [...jsonFiles(500), notes])).toHaveLength(500);
    expect(said(editor)).toEqual([]);
    expect(await dropFolder(editor, [...jsonFiles(501), notes])).toHaveLength(500);
    expect(said(editor)).toEqual([
        "The folder holds more than 500 JSON files: only the first 500 were taken.",
    ]);
});

test("a file of a folder that cannot be read is named, and none is taken", async () => {
    const { editor } = editorIn(later());
    expect(await dropFolder(editor, [...jsonFiles(1), GONE])).toBeNull();
    expect(said(editor)).toEqual(["a/gone.json could not be read. Nothing was opened."]);
});

test("a folder that holds nothing to open says so", async () => {
    const { editor } = editorIn(later());
    await takeFiles(editor, []);
    expect(said(editor)).toEqual(["There is no file that could be read: JSON is expected."]);
});
