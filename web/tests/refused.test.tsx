/* SPDX-License-Identifier: MIT */
// @vitest-environment jsdom
/* Texts that the server would not take, or did not: they stay where they were typed. */
import { EditorView } from "@codemirror/view";
import { act } from "react";
import { expect, test, vi } from "vitest";
import { readDocument } from "../src/model/documentJson.ts";
import type { Operation } from "../src/model/operation.ts";
import { apply } from "../src/model/operations.ts";
import { findParam, type Schema } from "../src/model/schema.ts";
import { createStores } from "../src/model/stores.ts";
import { checkText, cutToBytes } from "../src/model/values.ts";
import CodePanel from "../src/ui/code/CodePanel.tsx";
import type { Editor } from "../src/ui/editor.ts";
import { cutInput, useNameCut } from "../src/ui/fields/nameCut.ts";
import { useTypedText } from "../src/ui/fields/typedText.ts";
import { EditorContext } from "../src/ui/state.ts";
import { SCHEMA } from "./fixture.ts";
import { prepareShow } from "./show.ts";

const CODE = "/primitives/rod/code";
const limit = (name: string, value: number) => ({ name, value, unit: "bytes", doc: "" });
const schema: Schema = {
    ...SCHEMA,
    limits: [limit("code_bytes", 20), limit("name_bytes", 8)],
};
const scene = readDocument({
    primitives: { rod: { code: "old" } },
    root: { id: "root", type: "union" },
});

const show = prepareShow();

test("the bytes of a text count, and its control characters", () => {
    const name = findParam(schema.node, "name");
    const check = (text: string) => name && checkText(schema, name, text);
    expect(check("12345678")).toBeNull();
    expect(check("äöüß5")).toBe("9 bytes are above the maximum 8");
    expect(check("a\vb")).toBe("control character 11 is not allowed");
    expect(cutToBytes("äöüß5", 8)).toBe("äöüß");
    expect(cutToBytes("a🙂b", 4)).toBe("a");
});

test("what is pasted into a name is cut, what stands behind it stays", () => {
    const input = document.createElement("input");
    input.value = "abcüüü-z";
    input.setSelectionRange(6, 6);
    expect(cutInput(input, 8)).toBe("abcü-z");
    expect(input.selectionStart).toBe(4);
});

/* --- code --- */

/* An editor whose link shows edits at once, and a server that takes them or not. */
function setUp() {
    const stores = createStores(null);
    stores.document.setState({ schema, document: scene });
    const edit = vi.fn((ops: readonly Operation[]) => {
        const result = apply(scene, ops, schema);
        stores.document.setState({ document: result.ok ? result.document : scene, saved: false });
        return result.ok;
    });
    const gesture = () => ({ edit, end: () => undefined, cancel: () => undefined });
    const editor = { stores, link: { gesture } } as unknown as Editor;
    return { editor, stores, edit };
}

async function openCode(editor: Editor) {
    await show(
        <EditorContext value={editor}>
            <CodePanel place={CODE} />
        </EditorContext>,
    );
    await act(async () => void (await import("../src/ui/code/mount.ts")));
    const content = document.body.querySelector<HTMLElement>(".cm-content") as HTMLElement;
    const view = EditorView.findFromDOM(content) as EditorView;
    const write = (insert: string): void =>
        view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert } });
    const send = () => act(async () => void view.contentDOM.dispatchEvent(new Event("blur")));
    return {
        text: () => view.state.doc.toString(),
        write: async (insert: string): Promise<void> => {
            await act(async () => write(insert));
            await send();
        },
    };
}

const fault = () => document.body.querySelector(".code-fault")?.textContent ?? null;

test("code that is too long is not sent and stays, with the reason", async () => {
    const { editor, edit } = setUp();
    const { text, write } = await openCode(editor);
    const long = "/".repeat(21);
    await write(long);
    expect(edit).not.toHaveBeenCalled();
    expect(text()).toBe(long);
    expect(fault()).toBe("21 bytes are above the maximum 20");
    await write("short");
    expect(edit).toHaveBeenLastCalledWith([{ op: "set", at: CODE, value: "short" }]);
    expect([text(), fault()]).toEqual(["short", null]);
});

test("code that the server refused stays, with the reason", async () => {
    const { editor, stores } = setUp();
    const { text, write } = await openCode(editor);
    await write("mine");
    const problem = { code: "limit", place: CODE, message: "no room" };
    await act(async () => {
        stores.document.setState({ problems: new Map([[CODE, problem]]) });
        stores.document.setState({ document: scene, saved: true });
    });
    expect([text(), fault()]).toEqual(["mine", "no room"]);
});

const closeCode = (editor: Editor) => show(<EditorContext value={editor}>{null}</EditorContext>);

test("code that was refused is there again when its panel opens again, in its scene", async () => {
    const { editor, stores } = setUp();
    const long = "/".repeat(21);
    const { write } = await openCode(editor);
    await write(long);
    await closeCode(editor);
    stores.document.setState({ scene: "other" });
    expect((await openCode(editor)).text()).toBe("old");
    await closeCode(editor);
    stores.document.setState({ scene: null });
    const { text, write: mend } = await openCode(editor);
    expect([text(), fault()]).toEqual([long, "21 bytes are above the maximum 20"]);
    await mend("short");
    await act(async () => stores.document.setState({ saved: true }));
    await closeCode(editor);
    expect((await openCode(editor)).text()).toBe("short");
});

test("code that the server refuses after its panel was closed is there again", async () => {
    const { editor, stores } = setUp();
    const { write } = await openCode(editor);
    await write("mine");
    await closeCode(editor);
    const problem = { code: "limit", place: CODE, message: "no room" };
    stores.document.setState({ problems: new Map([[CODE, problem]]), document: scene });
    stores.document.setState({ saved: true });
    const { text } = await openCode(editor);
    expect([text(), fault()]).toEqual(["mine", "no room"]);
});

test("code follows what others write and what is undone", async () => {
    const { editor, stores } = setUp();
    const { text, write } = await openCode(editor);
    await write("mine");
    await act(async () => stores.document.setState({ saved: true }));
    await act(async () => stores.document.setState({ document: scene }));
    expect(text()).toBe("old");
});

/* --- a field --- */

/* Types as a browser does: React watches the property. */
const typeInto = (input: HTMLInputElement, text: string) =>
    act(async () => {
        const own = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value");
        own?.set?.call(input, text);
        input.dispatchEvent(new Event("input", { bubbles: true }));
    });

function Name() {
    const cut = useNameCut();
    return <input onInput={(event) => cut(event.currentTarget)} />;
}

test("a name has as many bytes as the server takes", async () => {
    await show(
        <EditorContext value={setUp().editor}>
            <Name />
        </EditorContext>,
    );
    const input = document.body.querySelector("input") as HTMLInputElement;
    await typeInto(input, "123456789");
    expect(input.value).toBe("12345678");
});

interface FieldProps {
    onCommit?: (text: string) => void;
    onCancel?: () => void;
    onRefuse?: (reason: string | null) => void;
    text?: string;
    mixed?: boolean;
}

const none = (): void => undefined;

function Field({
    onCommit = none,
    onCancel = none,
    onRefuse = none,
    text = "old",
    mixed,
}: FieldProps) {
    const { shown, listeners } = useTypedText({
        ...{ place: CODE, text, mixed, onInput: none, onCommit, onCancel, onRefuse },
        whyNot: (typed) => (typed.length > 4 ? "long" : typed === "" ? "empty" : null),
    });
    return <input value={shown} {...listeners} />;
}

/* A field in an editor, with what a hand does in it. */
async function openField(editor: Editor, props: FieldProps) {
    const draw = (more: FieldProps = {}) =>
        show(
            <EditorContext value={editor}>
                <Field {...props} {...more} />
            </EditorContext>,
        );
    await draw();
    const input = document.body.querySelector("input") as HTMLInputElement;
    return {
        draw,
        text: () => input.value,
        key: (name: string) =>
            act(async () => {
                input.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true }));
            }),
        type: (text: string) => typeInto(input, text),
    };
}

test("a text that a field cannot take stays until Escape", async () => {
    const onCommit = vi.fn();
    const onRefuse = vi.fn();
    const { text, key, type } = await openField(setUp().editor, { onCommit, onRefuse });
    await type("tools");
    await key("Enter");
    expect(onCommit).not.toHaveBeenCalled();
    expect(onRefuse).toHaveBeenLastCalledWith("long");
    expect(text()).toBe("tools");
    await key("Escape");
    expect(onRefuse).toHaveBeenLastCalledWith(null);
    expect(text()).toBe("old");
});

/* Takes a text, which the server refuses a moment later. */
async function refuseText(
    { stores }: Editor,
    { type, key, draw }: Awaited<ReturnType<typeof openField>>,
) {
    stores.document.setState({ saved: false });
    await type("bad");
    await key("Enter");
    await draw({ text: "bad" });
    const problem = { code: "syntax", place: CODE, message: "no" };
    await act(async () => {
        stores.document.setState({ problems: new Map([[CODE, problem]]) });
    });
    await draw({ text: "old" });
    await act(async () => stores.document.setState({ saved: true }));
}

test("a text that the server refuses comes back, and goes with Escape, as the reason does", async () => {
    const { editor, stores } = setUp();
    const onCommit = vi.fn();
    const field = await openField(editor, { onCommit });
    await refuseText(editor, field);
    expect(field.text()).toBe("bad");
    await field.key("Enter");
    expect(onCommit).toHaveBeenCalledTimes(1);
    await field.key("Escape");
    expect(field.text()).toBe("old");
    expect(stores.document.getState().problems.size).toBe(0);
});

test("a text that the server refused stays while its field is not shown", async () => {
    const { editor } = setUp();
    await refuseText(editor, await openField(editor, {}));
    await show(null);
    const { text, draw } = await openField(editor, {});
    expect(text()).toBe("bad");
    await draw({ text: "by others" });
    expect(text()).toBe("by others");
});

test("a field of values that differ changes nothing when it is emptied again", async () => {
    const onCommit = vi.fn();
    const onCancel = vi.fn();
    const onRefuse = vi.fn();
    const all = { onCommit, onCancel, onRefuse, mixed: true };
    const { text, key, type } = await openField(setUp().editor, all);
    expect(text()).toBe("");
    await type("a");
    await type("");
    await key("Enter");
    expect([onCommit.mock.calls.length, onCancel.mock.calls.length]).toEqual([0, 1]);
    expect(onRefuse).toHaveBeenLastCalledWith(null);
    await type("b");
    await key("Enter");
    expect(onCommit).toHaveBeenCalledWith("b");
});
