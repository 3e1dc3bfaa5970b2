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
import { takeFiles } from "../src/ui/drop/take.ts";
import type { Editor } from "../src/ui/editor.ts";
import AssetField from "../src/ui/fields/Asset.tsx";
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
        retry: () => undefined,
    };
    const opener = new Opener({ stores, link, rest: { readSchema } }, Promise.resolve(AUTHOR));
    return { stores, opener, connected };
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
