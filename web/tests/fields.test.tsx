// SPDX-License-Identifier: MIT
// @vitest-environment jsdom
// What fields of a form make of what is typed, pasted and dragged.
import { act, type ReactElement, useState } from "react";
import { createRoot } from "react-dom/client";
import { afterEach, expect, test, vi } from "vitest";
import { readDocument } from "../src/model/documentJson.ts";
import type { JsonObject } from "../src/model/json.ts";
import type { Operation } from "../src/model/operation.ts";
import { apply } from "../src/model/operations.ts";
import { nodeType, numberParam, type Param, readSchema } from "../src/model/schema.ts";
import { createStores } from "../src/model/stores.ts";
import { fromHex, toHex } from "../src/model/units.ts";
import type { Editor } from "../src/ui/editor.ts";
import ColourField from "../src/ui/fields/Colour.tsx";
import type { FieldProps } from "../src/ui/fields/types.ts";
/* Loaded when first shown, which is sooner with them here. */
import "../src/ui/fields/Points.tsx";
import "../src/ui/fields/Surface.tsx";
import "../src/ui/fields/Typeset.tsx";
import { VectorField } from "../src/ui/fields/Vector.tsx";
import { Form } from "../src/ui/form.tsx";
import { EditorContext } from "../src/ui/state.ts";

Object.assign(globalThis, { IS_REACT_ACT_ENVIRONMENT: true });

const opened: (() => void)[] = [];
afterEach(() => {
    for (const close of opened.splice(0)) {
        close();
    }
});

function show(element: ReactElement): void {
    const place = document.body.appendChild(document.createElement("div"));
    const root = createRoot(place);
    opened.push(() => {
        act(() => root.unmount());
        place.remove();
    });
    act(() => root.render(element));
}

function field(label: string): HTMLInputElement {
    const found = document.querySelector<HTMLInputElement>(`input[aria-label="${label}"]`);
    if (found === null) {
        throw new Error(`no field ${label}`);
    }
    return found;
}

/* One text after the other. React listens to the browser's own setter of values. */
function type(label: string, ...texts: readonly string[]): void {
    const input = field(label);
    const put = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value")?.set;
    act(() => input.focus());
    for (const text of texts) {
        act(() => {
            put?.call(input, text);
            input.dispatchEvent(new Event("input", { bubbles: true }));
        });
    }
    act(() => input.blur());
}

/* The arrow key up. */
function step(label: string): void {
    const key = new KeyboardEvent("keydown", { key: "ArrowUp", bubbles: true });
    act(() => void field(label).dispatchEvent(key));
}

function pasteInto(label: string, text: string): void {
    const event = new Event("paste", { bubbles: true, cancelable: true });
    Object.assign(event, { clipboardData: { getData: () => text } });
    act(() => void field(label).dispatchEvent(event));
}

/* What a field sends, the newest last. */
function sent<T>(label: string, value: T): { props: FieldProps<T>; values: T[] } {
    const values: T[] = [];
    const take = (next: T): void => void values.push(next);
    const none = (): void => undefined;
    const listeners = { onInput: take, onCommit: take, onCancel: none, onRefuse: none };
    return { props: { label, value, fallback: value, ...listeners }, values };
}

test("a whole vector of angles is typed and pasted in degrees", () => {
    const { props, values } = sent<number | readonly number[]>("turn", [0, 0, 0]);
    const param: Param = { ...numberParam("turn", { unit: "angle" }), type: "vec3" };
    show(<VectorField param={param} {...props} />);
    type("turn x", "0 90 0");
    pasteInto("turn y", "0° 90° -45°");
    pasteInto("turn z", "1 *2 3");
    expect(values).toEqual([
        [0, Math.PI / 2, 0],
        [0, Math.PI / 2, -Math.PI / 4],
    ]);
});

/* A field that shows what it sent last. */
function Following({ props }: { props: FieldProps<readonly number[]> }) {
    const [value, setValue] = useState(props.value);
    const take = (next: readonly number[]): void => {
        props.onCommit(next);
        setValue(next);
    };
    return <ColourField {...props} value={value} onInput={take} onCommit={take} />;
}

const frame = () => new Promise((done) => requestAnimationFrame(done));

/* Drags the number of a field sideways, by these many pixels one after the other. */
async function drag(label: string, ways: readonly number[]): Promise<void> {
    const input = field(label);
    Object.assign(input, { setPointerCapture: () => undefined });
    let clientX = 0;
    const point = (kind: string): void => {
        const event = new MouseEvent(kind, { button: 0, clientX, bubbles: true });
        Object.assign(event, { pointerId: 1, pointerType: "touch" });
        act(() => void input.dispatchEvent(event));
    };
    point("pointerdown");
    for (const way of ways) {
        clientX += way;
        point("pointermove");
        await act(frame);
    }
    point("pointerup");
}

test("the strength of a colour goes up and back without another colour", async () => {
    const grey = fromHex("#808080") ?? [];
    const { props, values } = sent<readonly number[]>("glow", grey);
    show(
        <EditorContext.Provider value={{ stores: createStores(null) } as Editor}>
            <Following props={props} />
        </EditorContext.Provider>,
    );
    await act(async () => document.querySelector<HTMLElement>(".colour-button")?.click());
    const strength = "glow Strength";
    await drag(strength, [4, 20, 40, 60, -60, -100]);
    expect(Math.max(...values.flat())).toBeGreaterThan(1.1 * Math.max(...grey));
    expect(values.at(-1)).toEqual(grey);
    type(strength, "3");
    expect(field(strength).value).toBe("3");
    expect(values.at(-1)).toEqual(grey.map((x) => 3 * x));
    expect(document.querySelector(".colour-hex")?.textContent).toBe("#808080");
    type(strength, "10");
    expect(values.at(-1)?.every((x) => x > 2)).toBe(true);
    type(strength, "1");
    expect(toHex(values.at(-1) as [number, number, number])).toBe("#808080");
});

/* --- several nodes at once --- */

const row = (type: string, name: string): JsonObject => ({ name, type, default: {}, doc: name });
const kind = (type: string, children: string, params: JsonObject[]): JsonObject => ({
    ...{ type, group: "primitive", exactness: "exact", doc: type, words: "" },
    ...{ children, params },
});
const SCHEMA = readSchema({
    "x-fieldcast": {
        nodes: [
            kind("union", "many", []),
            kind("parametric", "none", [row("surface", "surface")]),
            kind("polygon", "none", [{ ...row("points", "points"), default: [] }]),
        ],
    },
});

/* The form of two selected nodes of a type, and what the document has for each after edits. */
async function form(type: string, name: string, values: readonly [JsonObject, JsonObject]) {
    const stores = createStores(null);
    const nodes = values.map((params, i) => ({ id: `n${i}`, type, params }));
    const scene = readDocument({ root: { id: "root", type: "union", children: nodes } });
    stores.document.setState({ document: scene, schema: SCHEMA, scene: "s" });
    stores.view.setState({ selection: ["n1", "n0"] });
    const edit = (ops: readonly Operation[]): void => {
        const now = stores.document.getState().document;
        const result = now && apply(now, ops, SCHEMA);
        if (!result?.ok) {
            throw new Error(result?.problem.message);
        }
        stores.document.setState({ document: result.document });
    };
    const end = (): void => undefined;
    const link = { edit, gesture: () => ({ edit, end, cancel: end }) };
    const rest = { request: () => new Promise(() => undefined) };
    const editor = { stores, link, rest } as unknown as Editor;
    const params = nodeType(SCHEMA, type)?.params ?? [];
    show(
        <EditorContext.Provider value={editor}>
            <Form params={params} base="/nodes/n0/params" owner="n0" />
        </EditorContext.Provider>,
    );
    const loaded = async (): Promise<void> => {
        await act(frame);
        expect(document.querySelector(".form-field > *")).not.toBeNull();
    };
    await vi.waitFor(loaded, 60_000);
    return (id: string) => stores.document.getState().document?.nodes.get(id)?.params[name];
}

const A = { x: "s", y: "t", z: "0", s: [0, 1], t: [0, 2] };
const B = { x: "s*t", y: "t", z: "s^2", s: [5, 9], t: [0, 2] };

test("typing and stepping in one of two surfaces changes in the other what was touched", async () => {
    const now = await form("parametric", "surface", [{ surface: A }, { surface: B }]);
    const [x, y, z] = ["x", "y", "z"].map((part) => field(`surface ${part}`));
    expect([x, y, z].map((one) => one?.value)).toEqual(["", "t", ""]);
    expect(x?.placeholder).toBe("mixed");
    expect(field("s from").placeholder).toBe("mixed");
    expect(field("t to").value).toBe("2");
    type("surface y", "t + 1");
    expect([now("n0"), now("n1")]).toEqual([
        { ...A, y: "t + 1" },
        { ...B, y: "t + 1" },
    ]);
    step("s to");
    expect([now("n0"), now("n1")]).toEqual([
        { ...A, y: "t + 1", s: [0, 1.1] },
        { ...B, y: "t + 1", s: [5, 9.1] },
    ]);
});

test("what differs stays where a text is typed and taken away again", async () => {
    const now = await form("parametric", "surface", [{ surface: A }, { surface: B }]);
    for (const label of ["surface x", "s from"]) {
        type(label, "1", "");
        expect(field(label).value).toBe("");
        expect(field(label).placeholder).toBe("mixed");
    }
    expect([now("n0"), now("n1")]).toEqual([A, B]);
    expect(document.querySelector(".form-error")).toBeNull();
});

test("points of outlines that differ are not changed together", async () => {
    const triangle = [
        [0, 0],
        [1, 0],
        [0, 1],
    ];
    await form("polygon", "points", [{ points: triangle }, { points: [...triangle, [-1, 0]] }]);
    expect(document.querySelector(".form-field")?.textContent).toContain("mixed");
    expect(document.querySelector(".points, input")).toBeNull();
});
