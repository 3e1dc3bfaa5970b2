/* SPDX-License-Identifier: MIT */
/* What commands look at and do; the table that names them is commands.ts. */
import { ballOf, boxAround } from "./bounds.ts";
import {
    axes,
    type Ball,
    type Box,
    type Camera,
    distance,
    dolly,
    frame,
    frameBox,
    orbit,
    pan,
    printCamera,
    type ViewName,
    viewFrom,
} from "./camera.ts";
import { clip, paste } from "./clipboard.ts";
import { everyNode, modelNamed, type SceneDocument, topmost } from "./document.ts";
import { type Edit, movable, nameAll, removeNodes, reorder, setVisible } from "./edits.ts";
import type { Motion } from "./grip.ts";
import { movablesOf } from "./movables.ts";
import { isParked, parkable } from "./moves.ts";
import type { Operation } from "./operation.ts";
import { limitOf, type Schema } from "./schema.ts";
import { sectionSeenFrom } from "./section.ts";
import { addNotice, type Stores, setPreferences } from "./stores.ts";
import { capitalised, text } from "./texts.ts";
import { dot, subtract, type Vector } from "./transform.ts";
import type { HandSettings } from "./view.ts";

/* What commands need from the page around the model. */
export interface App {
    readonly stores: Stores;
    edit(ops: readonly Operation[], options?: { group?: string; label?: string }): boolean;
    undo(): void;
    redo(): void;
    /* Width over height of the picture. */
    aspect(): number;
    /* A box around what is to be seen of nodes, or of all without ids; null where none is known. */
    bounds(nodes: readonly string[]): Promise<Box | null>;
    writeClipboard(text: string): void;
    readClipboard(): Promise<string>;
    /* Saves the document as a file; opens the chooser for some, or for a folder. */
    download(): void;
    upload(folder?: boolean): void;
    /* Puts a copy of a node into the library. */
    saveToLibrary(node: string): void;
}

/* --- what commands look at --- */

export function documentOf(app: App): SceneDocument | null {
    return app.stores.document.getState().document;
}

export function selectionOf(app: App): readonly string[] {
    const document = documentOf(app);
    const { selection } = app.stores.view.getState();
    return document ? selection.filter((id) => document.nodes.has(id)) : [];
}

export type Reason = (app: App) => string | null;

export const never: Reason = () => null;
export const needsScene: Reason = (app) => (documentOf(app) ? null : text("why.noScene"));
export const needsSelection: Reason = (app) =>
    needsScene(app) ?? (selectionOf(app).length > 0 ? null : text("why.noSelection"));

export function needsMovable(least: number): Reason {
    return (app) => {
        const document = documentOf(app);
        const reason = needsSelection(app);
        if (reason !== null || !document) {
            return reason;
        }
        const count = movable(document, selectionOf(app)).length;
        if (count === 0) {
            return text("why.onlyRoot");
        }
        return count < least ? text("why.twoNeeded") : null;
    };
}

export const needsOne: Reason = (app) =>
    needsSelection(app) ?? (selectionOf(app).length === 1 ? null : text("why.oneOnly"));

export function canReorder(direction: -1 | 1): Reason {
    return (app) => {
        const document = documentOf(app);
        const id = selectionOf(app)[0] ?? "";
        const reason = needsOne(app);
        if (reason !== null || !document) {
            return reason;
        }
        return reorder(document, id, direction) ? null : text("why.noParentStep");
    };
}

export const needsInstance: Reason = (app) => {
    const { document, schema } = app.stores.document.getState();
    const node = document?.nodes.get(selectionOf(app)[0] ?? "");
    const instance = document !== null && modelNamed(schema, document, node) !== null;
    return needsOne(app) ?? (instance ? null : text("why.noInstance"));
};

/* One node that can become a model. */
export const needsPart: Reason = (app) =>
    needsOne(app) ??
    needsMovable(1)(app) ??
    (needsInstance(app) === null ? text("why.isInstance") : null);

export const canDissolve: Reason = (app) => {
    const document = documentOf(app);
    const node = document?.nodes.get(selectionOf(app)[0] ?? "");
    const reason = needsOne(app) ?? needsMovable(1)(app);
    return reason ?? (node && node.children.length > 0 ? null : text("why.noChildren"));
};

/* Is anything selected that a hand can move, turn or scale? */
export function canMove(motion: Motion): Reason {
    return (app) => {
        const { document, schema } = app.stores.document.getState();
        const { selection, subject } = app.stores.view.getState();
        const movables = document ? movablesOf(document, schema, selection, subject) : [];
        return movables.some(({ motions }) => motions.includes(motion))
            ? null
            : (needsScene(app) ?? text("why.notMovable"));
    };
}

export const canPark: Reason = (app) => {
    const document = documentOf(app);
    const some = document !== null && parkable(document, selectionOf(app)).length > 0;
    return needsMovable(1)(app) ?? (some ? null : text("why.parked"));
};

export const canUnpark: Reason = (app) => {
    const document = documentOf(app);
    const some = document !== null && selectionOf(app).some((id) => isParked(document, id));
    return needsSelection(app) ?? (some ? null : text("why.notParked"));
};

export const needsLens: Reason = (app) => {
    const aperture = documentOf(app)?.camera.aperture;
    return needsScene(app) ?? (Number(aperture ?? 0) > 0 ? null : text("why.noLens"));
};

export function isIsolating(app: App): boolean {
    return app.stores.view.getState().isolated.length > 0;
}

export function hiddenNodes(document: SceneDocument): string[] {
    return everyNode(document).filter((id) => document.nodes.get(id)?.common.visible === false);
}

/* --- what commands do --- */

/* Sends an edit and selects what it names. */
export function perform(app: App, edit: Edit): boolean {
    if (edit.ops.length === 0 || !app.edit(edit.ops, { label: edit.label })) {
        return false;
    }
    app.stores.view.setState({ selection: edit.select, subject: { kind: "nodes" } });
    return true;
}

/* Tells what is gone, with a way back beside it. */
export function tellDeleted(app: Pick<App, "stores">, name: string, label: string): void {
    const message = text("edit.deleted", { name: capitalised(name) });
    addNotice(app.stores.notices, {
        level: "info",
        code: "deleted",
        message,
        acts: [{ kind: "undo", label }],
    });
}

export function deleteNodes(app: App): void {
    const { document, schema } = app.stores.document.getState();
    const ids = document ? movable(document, selectionOf(app)) : [];
    const edit = document && removeNodes(document, schema, ids);
    if (document && edit && perform(app, edit)) {
        tellDeleted(app, nameAll(document, ids), edit.label);
    }
}

export function onDocument(
    build: (document: SceneDocument, ids: readonly string[], schema: Schema) => Edit | null,
) {
    return (app: App): void => {
        const { document, schema } = app.stores.document.getState();
        const edit = document && build(document, selectionOf(app), schema);
        if (edit) {
            perform(app, edit);
        }
    };
}

/* The camera is the user's own: it changes without an edit. What a hand holds follows the pointer by
 * the camera that it was taken with, so that one rests meanwhile. */
export function moveCamera(app: Pick<App, "stores">, change: (camera: Camera) => Camera): void {
    if (app.stores.view.getState().held) {
        return;
    }
    app.stores.camera.setState(({ camera }) => ({ camera: change(camera), own: true }));
}

interface Extent {
    readonly box: Box;
    /* The page's rough guess, where the server knows no box. */
    readonly guess: Ball | null;
}

/* Of what is to be seen of nodes, or of all without ids; null: there is no scene, or another one was
 * opened meanwhile. */
export async function extentOf(app: App, nodes: readonly string[]): Promise<Extent | null> {
    const { document, schema, scene } = app.stores.document.getState();
    const few = nodes.length <= limitOf(schema, "isolated", 256);
    const box = few ? await app.bounds(nodes).catch(() => null) : null;
    if (!document || app.stores.document.getState().scene !== scene) {
        return null;
    }
    if (box) {
        return { box, guess: null };
    }
    const guess = ballOf(document, schema, nodes.length > 0 ? nodes : undefined);
    return { box: boxAround(guess), guess };
}

/* All that is shown, where no nodes are named. */
export async function frameNodes(app: App, ids?: readonly string[]): Promise<void> {
    const extent = await extentOf(app, ids ?? app.stores.view.getState().isolated);
    if (extent) {
        const { box, guess } = extent;
        moveCamera(app, (camera) =>
            guess ? frame(camera, guess, app.aspect()) : frameBox(camera, box, app.aspect()),
        );
    }
}

export function copyNodes(app: App): void {
    const { document, schema, scene } = app.stores.document.getState();
    if (document) {
        app.writeClipboard(clip(schema, document, selectionOf(app), scene ?? ""));
    }
}

export async function pasteNodes(app: App): Promise<void> {
    const content = await app.readClipboard().catch(() => "");
    const { document, schema, scene } = app.stores.document.getState();
    const edit = document && paste(document, schema, selectionOf(app), content, scene ?? "");
    if (edit) {
        perform(app, edit);
    } else {
        const message = text("why.clipboard");
        addNotice(app.stores.notices, { level: "info", code: "clipboard", message });
    }
}

export function hideNodes(app: App): void {
    const document = documentOf(app);
    const ids = document ? selectionOf(app) : [];
    const hidden = ids.every((id) => document?.nodes.get(id)?.common.visible === false);
    onDocument((scene) => setVisible(scene, ids, hidden))(app);
}

/* Ends the isolation; where nothing is isolated, shows what is hidden. */
export function showAll(app: App): void {
    if (isIsolating(app)) {
        app.stores.view.setState({ isolated: [] });
        return;
    }
    const document = documentOf(app);
    const ids = document ? hiddenNodes(document) : [];
    if (document && ids.length > 0) {
        app.edit(setVisible(document, ids, true).ops, { label: "show all" });
    }
}

/* Cuts what this page shows through its middle, or no longer. No edit. */
export async function toggleSection(app: App): Promise<void> {
    const { view, camera } = app.stores;
    const { section, isolated } = view.getState();
    const extent = section === null ? await extentOf(app, isolated) : null;
    view.setState(
        extent
            ? {
                  extent: extent.box,
                  section: sectionSeenFrom(camera.getState().camera.position, extent.box),
              }
            : { section: null },
    );
}

/* This page shows the selection alone, or all again. No edit. */
export function isolate(app: App): void {
    const { document, schema } = app.stores.document.getState();
    if (document) {
        const most = limitOf(schema, "isolated", 256);
        const chosen = topmost(document, selectionOf(app)).slice(0, most);
        app.stores.view.setState({ isolated: isIsolating(app) ? [] : chosen });
    }
}

/* From an instance to the tree that it shows. */
export function editModel(app: App): void {
    const { document, schema } = app.stores.document.getState();
    const node = document?.nodes.get(selectionOf(app)[0] ?? "");
    const model = document && modelNamed(schema, document, node);
    if (model) {
        app.stores.view.setState({ selection: [model.root], subject: { kind: "nodes" } });
    }
}

export function climb(app: App): void {
    const parent = documentOf(app)?.nodes.get(selectionOf(app).at(-1) ?? "")?.parent;
    if (parent != null) {
        app.stores.view.setState({ selection: [parent] });
    }
}

export const changeHands =
    (change: (hands: HandSettings) => Partial<HandSettings>) =>
    ({ stores }: App): void => {
        const { hands } = stores.view.getState().preferences;
        setPreferences(stores.view, { hands: { ...hands, ...change(hands) } });
    };

/* The gizmo of one motion; the same one again takes it away. */
export const chooseTool = (motion: Motion) =>
    changeHands(({ tool }) => ({ tool: tool === motion ? null : motion }));

export function saved(app: App): void {
    const { saved: done, waiting, revision } = app.stores.document.getState();
    const message = done ? text("saved", { revision }) : text("waiting", { count: waiting });
    addNotice(app.stores.notices, { level: "info", code: "saved", message });
}

export function next<T>(items: readonly T[], now: T): T {
    return items[(items.indexOf(now) + 1) % items.length] ?? now;
}

const STEP = (5 * Math.PI) / 180;
/* Share of the view's height that a key pans, and of the distance that a key dollies. */
const PAN_STEP = 0.05;
const DOLLY_STEP = 0.9;

export const orbitBy = (x: number, y: number) => (app: App) =>
    moveCamera(app, (camera) => orbit(camera, x * STEP, y * STEP));
/* The scene shifts against the arrow, as if the camera walked. */
export const panBy = (x: number, y: number) => (app: App) =>
    moveCamera(app, (camera) => pan(camera, -x * PAN_STEP, y * PAN_STEP, 1));
export const dollyBy = (steps: number) => (app: App) =>
    moveCamera(app, (camera) => dolly(camera, DOLLY_STEP ** steps));
export const lookFrom = (name: ViewName) => (app: App) =>
    moveCamera(app, (camera) => viewFrom(camera, name));

/* What is at `place` will be sharp, as seen by the camera of the view. */
export function focusOn(app: App, place: Vector): void {
    const { camera } = app.stores.camera.getState();
    const away = dot(subtract(place, camera.position), axes(camera).forward);
    const focus = Number(away.toPrecision(4));
    app.edit([{ op: "set", at: "/camera/focus", value: focus }], { label: "focus" });
}

export function saveCamera(app: App): void {
    const { camera } = app.stores.camera.getState();
    const value = { ...documentOf(app)?.camera, ...printCamera(camera) };
    if (
        distance(camera) > 0 &&
        app.edit([{ op: "set", at: "/camera", value }], { label: "set camera" })
    ) {
        app.stores.camera.setState({ own: false });
    }
}
