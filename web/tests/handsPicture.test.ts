// SPDX-License-Identifier: MIT
// @vitest-environment jsdom
// What a hand holds in the picture while the picture changes.
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { moveCamera } from "../src/model/actions.ts";
import { DEFAULT_CAMERA, dolly } from "../src/model/camera.ts";
import { readDocument } from "../src/model/documentJson.ts";
import { handlesOf } from "../src/model/handles.ts";
import type { Operation } from "../src/model/operation.ts";
import { projectionOf, type Spot } from "../src/model/projection.ts";
import { readSchema } from "../src/model/schema.ts";
import { createStores, NO_FRAME } from "../src/model/stores.ts";
import { Hands } from "../src/overlay/hands.ts";
import type { Holding, PointerActions, Press } from "../src/overlay/pointer.ts";
import { SectionHand } from "../src/overlay/section.ts";
import type { Editor } from "../src/ui/editor.ts";
import { handsPage } from "../src/ui/view/pointer.ts";

const SIZE = { width: 640, height: 360 };
const SCHEMA = readSchema({
    "x-fieldcast": {
        nodes: [
            {
                type: "ball",
                group: "primitive",
                children: "none",
                params: [
                    {
                        ...{ name: "radius", type: "float", default: 0.5, unit: "length" },
                        ...{ min: 0, max: 100, handle: "radius, 0, 0" },
                    },
                ],
            },
        ],
    },
});
const DOCUMENT = readDocument({
    root: { id: "root", type: "union", children: [{ id: "a", type: "ball" }] },
});

/* jsdom lays nothing out. */
class Observer {
    readonly #told: () => void;

    constructor(told: () => void) {
        this.#told = told;
    }

    observe(): void {
        this.#told();
    }

    disconnect(): void {}
}

const stores = createStores(null);
let hands: Hands;
let edits: (readonly Operation[])[];

function look(camera: typeof DEFAULT_CAMERA): void {
    stores.link.setState({ frame: { ...NO_FRAME, state: "moving", camera } });
}

beforeEach(() => {
    vi.stubGlobal("ResizeObserver", Observer);
    vi.spyOn(HTMLCanvasElement.prototype, "getContext").mockReturnValue(null);
    edits = [];
    stores.document.setState({ scene: "one", document: DOCUMENT, schema: SCHEMA });
    stores.view.setState({ selection: ["a"], subject: { kind: "nodes" } });
    look(DEFAULT_CAMERA);
    const element = document.body.appendChild(document.createElement("div"));
    Object.defineProperty(element, "clientWidth", { value: SIZE.width });
    Object.defineProperty(element, "clientHeight", { value: SIZE.height });
    const edit = (ops: readonly Operation[]): boolean => edits.push(ops) > 0;
    const gesture = () => ({ group: "1", edit, end: () => undefined, cancel: () => undefined });
    hands = new Hands(handsPage({ stores, link: { gesture } } as unknown as Editor), element);
});

afterEach(() => {
    hands.end();
    document.body.replaceChildren();
    vi.restoreAllMocks();
    vi.unstubAllGlobals();
});

const press = ({ x, y }: Spot): Press => ({
    ...{ id: 1, type: "mouse", button: 0, buttons: 1, x, y },
    ...{ shift: false, ctrl: false, alt: false, at: 0 },
});

/* Takes hold of the radius. */
function hold(): { holding: Holding; from: Press } {
    const projection = projectionOf(DEFAULT_CAMERA, SIZE);
    const [handle] = handlesOf(DOCUMENT, SCHEMA, ["a"], { kind: "nodes" }, projection);
    const from = press(handle?.spot ?? { x: 0, y: 0 });
    const holding = hands.grab(from);
    if (holding === null || holding === "taken") {
        throw new Error("nothing to hold");
    }
    holding.start();
    return { holding, from };
}

test("a camera that moves while a parameter is held does not change its value", () => {
    const { holding, from } = hold();
    look(dolly(DEFAULT_CAMERA, 0.5));
    holding.move(from);
    const [[op] = []] = edits;
    expect(op).toMatchObject({ op: "set", at: "/nodes/a/params/radius" });
    expect(op && "value" in op ? op.value : null).toBeCloseTo(0.5, 6);
    holding.end();
});

test("the wheel leaves the camera alone while something is held", () => {
    const { camera } = stores.camera.getState();
    const zoomed = dolly(camera, 0.5);
    const { holding } = hold();
    moveCamera({ stores }, () => zoomed);
    expect(stores.camera.getState().camera).toBe(camera);
    holding.end();
    moveCamera({ stores }, () => zoomed);
    expect(stores.camera.getState().camera).toBe(zoomed);
});

test("the wheel leaves the camera alone while the arrow of the section is held", () => {
    const [field, arrow] = [document.createElement("div"), document.createElement("div")];
    field.setPointerCapture = () => undefined;
    document.body.append(field);
    const told = document.createElement("div");
    const outline = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    stores.view.setState({ section: { axis: "x", at: 0, flipped: false } });
    const actions = { gesture: () => undefined } as unknown as PointerActions;
    const hand = new SectionHand(stores, actions, { field, room: field, arrow, outline, told });
    const point = (type: string, clientX: number) =>
        field.dispatchEvent(new MouseEvent(`pointer${type}`, { clientX, buttons: 1 }));
    const { camera } = stores.camera.getState();
    const zoomed = dolly(camera, 0.5);
    point("down", 10);
    point("move", 30);
    moveCamera({ stores }, () => zoomed);
    expect(stores.camera.getState().camera).toBe(camera);
    point("up", 30);
    moveCamera({ stores }, () => zoomed);
    expect(stores.camera.getState().camera).toBe(zoomed);
    stores.camera.setState({ camera });
    point("down", 10);
    point("move", 30);
    hand.end();
    expect(stores.view.getState().held).toBe(false);
});

test("what was taken in one scene changes nothing in another with the same names", () => {
    const { holding, from } = hold();
    holding.move({ ...from, x: from.x + 20 });
    expect(edits).toHaveLength(1);
    stores.document.setState({ scene: "other" });
    holding.move({ ...from, x: from.x + 40 });
    holding.end();
    expect(edits).toHaveLength(1);
});
