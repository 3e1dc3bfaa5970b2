// SPDX-License-Identifier: MIT
// @vitest-environment jsdom
// What fields of a form make of what is typed, pasted and dragged.
import { act, type ReactElement } from "react";
import { createRoot } from "react-dom/client";
import { afterEach, expect, test } from "vitest";
import { numberParam, type Param } from "../src/model/schema.ts";
import type { FieldProps } from "../src/ui/fields/types.ts";
import { VectorField } from "../src/ui/fields/Vector.tsx";

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

/* React listens to the browser's own setter of values. */
function type(label: string, text: string): void {
    const input = field(label);
    const put = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value")?.set;
    act(() => input.focus());
    act(() => {
        put?.call(input, text);
        input.dispatchEvent(new Event("input", { bubbles: true }));
    });
    act(() => input.blur());
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
