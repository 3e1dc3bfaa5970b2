/* SPDX-License-Identifier: MIT */
/* Hands in the picture: the gizmo, the drag or the keys that move what is selected. Drawn by the page
 * with the camera of the picture shown, so that it stands where its object is. Acts on a drag only;
 * a click goes through. */
import { isCorner } from "../model/corners.ts";
import { clearOf, gizmoParts, type Part, partAt } from "../model/gizmo.ts";
import { type Axis, axisOf, type Motion } from "../model/grip.ts";
import { shownGuide } from "../model/guide.ts";
import { dragHandle, type Handle, handleAt, handleLabel, handlesOf } from "../model/handles.ts";
import { looksThrough } from "../model/marks.ts";
import { frameOf, type Movable, movablesOf, pivotOf } from "../model/movables.ts";
import { type Projection, projectionOf, type Spot } from "../model/projection.ts";
import { surfaceUnder, type Target, targetsOf } from "../model/snapping.ts";
import type { Stores } from "../model/stores.ts";
import { add, scale } from "../model/transform.ts";
import { Corners, type CornersPage } from "./corners.ts";
import { Hold, type HoldKeys, STEP_NAMES, type Step } from "./hold.ts";
import { colorOf, line, paintGizmo, paintHandles, paintLabel, ringAt, stroke } from "./paint.ts";
import type { Holding, Press } from "./pointer.ts";
import { shownCamera } from "./shown.ts";

export interface HandsPage extends CornersPage {
    readonly stores: Stores;
}

/* A part is held from this far, in pixels. */
const SLOP_MOUSE = 8;
const SLOP_TOUCH = 24;
/* A handle that is nearer to the middle of the gizmo is not shown. */
const NEAR_MIDDLE = 14;
const ORIGIN: Spot = { x: 0, y: 0 };

/* What is shown while no part is held. */
interface Rest {
    readonly handles: readonly Handle[];
    readonly parts: readonly Part[];
}

export class Hands {
    readonly #page: HandsPage;
    readonly #element: HTMLElement;
    readonly #canvas: HTMLCanvasElement;
    readonly #stops: (() => void)[] = [];
    readonly #corners: Corners;
    #pointer: Spot | null = null;
    #hot: Part | null = null;
    #hold: Hold | null = null;
    /* A parameter that is being dragged. */
    #handle: { readonly label: string; readonly at: Spot; readonly key: string } | null = null;
    #hotHandle: string | null = null;
    #drawing = 0;
    /* The browser copies the whole canvas after any stroke, and after clearing an empty one. */
    #painted = true;
    #size = { width: 1, height: 1 };

    constructor(page: HandsPage, element: HTMLElement) {
        this.#page = page;
        this.#element = element;
        this.#corners = new Corners(page);
        this.#canvas = document.createElement("canvas");
        this.#canvas.className = "view-hands";
        this.#canvas.setAttribute("aria-hidden", "true");
        this.#canvas.dataset.testid = "hands";
        element.append(this.#canvas);
        this.#listen();
        this.#motion(page.stores.view.getState().motion);
        this.#draw();
    }

    end(): void {
        this.#finish("cancel");
        for (const stop of this.#stops) {
            stop();
        }
        cancelAnimationFrame(this.#drawing);
        this.#canvas.remove();
    }

    /* --- what the pointer does --- */

    /* A press on the gizmo; null: it is for the camera. While keys move something, a press ends it. */
    grab(press: Press): Holding | "taken" | null {
        if (this.#hold !== null) {
            this.#finish(press.button === 0 ? "end" : "cancel");
            return "taken";
        }
        const slop = press.type === "touch" ? SLOP_TOUCH : SLOP_MOUSE;
        const handle = press.button === 0 ? handleAt(this.#handles(), press, slop) : null;
        if (handle !== null) {
            return this.#holdHandle(handle, press);
        }
        const part = press.button === 0 ? partAt(this.#parts(), press, slop) : null;
        if (part === null) {
            return null;
        }
        return {
            start: () => this.#begin(part.constraint, press),
            move: (to) => this.#to(to, keysOf(to.shift, to.ctrl, this.#snaps)),
            end: () => this.#finish("end"),
            cancel: () => this.#finish("cancel"),
        };
    }

    /* The parameter follows the pointer, from where the handle was. */
    #holdHandle(handle: Handle, from: Spot): Holding {
        let step: Step | null = null;
        /* The one that the handle was seen with: a camera that moves meanwhile changes no value. */
        const projection = this.#projection();
        const finish = (how: "end" | "cancel"): void => {
            step?.[how]();
            this.#handle = null;
            this.#redraw();
        };
        return {
            start: () => {
                this.#corners.choose(isCorner(handle) ? handle.key : null);
                step = this.#page.begin(`change ${handle.param.name} of`);
            },
            move: (to) => {
                const change =
                    projection && dragHandle(handle, projection, from, to, to.ctrl !== this.#snaps);
                if (change) {
                    step?.edit([change.op]);
                    this.#handle = { label: change.label, at: to, key: handle.key };
                    this.#redraw();
                }
            },
            end: () => finish("end"),
            cancel: () => finish("cancel"),
        };
    }

    /* True: it was for a corner or an edge of a flat shape, and is for nothing else. */
    click(spot: Spot): boolean {
        const taken = this.#corners.click(this.#handles(), spot, SLOP_MOUSE);
        this.#redraw();
        return taken;
    }

    /* The same for a double click, which puts a corner on an edge. */
    double(spot: Spot): boolean {
        const projection = this.#projection();
        return (
            projection !== null &&
            this.#corners.double(this.#handles(), projection, spot, SLOP_MOUSE)
        );
    }

    #begin(constraint: Part["constraint"], from: Spot): void {
        const { space, pivot: mode } = this.#page.stores.view.getState().preferences.hands;
        const movables = this.#movables();
        const projection = this.#projection();
        if (movables.length === 0 || projection === null) {
            return;
        }
        const pivot = pivotOf(movables, mode);
        const step = this.#page.begin(STEP_NAMES[constraint.motion]);
        const targets = (): readonly Target[] => this.#targets();
        const surface = this.#surface(projection);
        this.#hold = new Hold({
            ...{ movables, pivot, mode, space, projection },
            ...{ from, constraint, step, targets, surface },
        });
        this.#redraw();
    }

    #to(spot: Spot, keys: HoldKeys): void {
        this.#hold?.to(spot, keys);
        this.#redraw();
    }

    #finish(how: "end" | "cancel"): void {
        const hold = this.#hold;
        this.#hold = null;
        hold?.[how]();
        if (this.#page.stores.view.getState().motion !== null) {
            this.#page.stores.view.setState({ motion: null });
        }
        this.#redraw();
    }

    #hover(event: PointerEvent): void {
        const box = this.#element.getBoundingClientRect();
        this.#pointer = { x: event.clientX - box.left, y: event.clientY - box.top };
        if (this.#page.stores.view.getState().motion !== null) {
            const { shiftKey, ctrlKey, metaKey } = event;
            this.#to(this.#pointer, keysOf(shiftKey, ctrlKey || metaKey, this.#snaps));
            return;
        }
        if (event.buttons !== 0 || event.pointerType === "touch" || this.#hold !== null) {
            return;
        }
        const over = this.#element.contains(event.target as Node);
        const handle = over ? handleAt(this.#handles(), this.#pointer, SLOP_MOUSE) : null;
        const part = over && !handle ? partAt(this.#parts(), this.#pointer, SLOP_MOUSE) : null;
        const free = over && !handle && !part;
        this.#corners.hover(free ? this.#handles() : [], this.#pointer, SLOP_MOUSE);
        this.#hot = part;
        this.#hotHandle = handle?.key ?? null;
        this.#element.dataset.grab = part === null && handle === null ? "" : "can";
        this.#redraw();
    }

    /* What keys move ends where it is when something else is pressed. */
    #pressOutside(event: PointerEvent): void {
        const moving = this.#page.stores.view.getState().motion !== null;
        if (moving && !this.#element.contains(event.target as Node)) {
            this.#finish("end");
        }
    }

    get #snaps(): boolean {
        return this.#page.stores.view.getState().preferences.hands.snap;
    }

    /* --- keys: G, R, S begin, then axes and digits --- */

    #motion(motion: Motion | null): void {
        if (motion === null) {
            if (this.#hold !== null) {
                this.#finish("cancel");
            }
            return;
        }
        this.#hold?.cancel();
        this.#hold = null;
        const { width, height } = this.#size;
        const from = this.#pointer ?? { x: width / 2, y: height / 2 };
        this.#begin({ motion, axis: null, plane: false }, from);
        if (this.#hold === null) {
            this.#page.stores.view.setState({ motion: null });
        }
    }

    #key(event: KeyboardEvent): void {
        const hold = this.#hold;
        const { motion, held } = this.#page.stores.view.getState();
        const moves = hold !== null && motion !== null;
        const target = event.target as Node;
        const here = !held && (target === document.body || this.#element.contains(target));
        if (moves ? this.#act(hold, event) : here && this.#corners.key(this.#handles(), event)) {
            event.preventDefault();
            event.stopImmediatePropagation();
            this.#redraw();
        }
    }

    #act(hold: Hold, event: KeyboardEvent): boolean {
        if (event.ctrlKey || event.metaKey || event.altKey) {
            return false;
        }
        const axis = "xyz".indexOf(event.key.toLowerCase());
        if (axis >= 0) {
            hold.constrain(axis as Axis, event.shiftKey);
            return true;
        }
        if (event.key === "Enter" || event.key === "Escape") {
            this.#finish(event.key === "Enter" ? "end" : "cancel");
            return true;
        }
        return hold.type(event.key);
    }

    /* --- drawing --- */

    #movables(): readonly Movable[] {
        const { document, schema } = this.#page.stores.document.getState();
        const { selection, subject } = this.#page.stores.view.getState();
        const seen = shownCamera(this.#page.stores);
        /* Who looks through the camera moves it by looking. */
        const inside =
            subject.kind === "camera" && document && seen && looksThrough(document, seen);
        return document && !inside ? movablesOf(document, schema, selection, subject) : [];
    }

    /* Ids of what is moved, or nothing of the tree. */
    get #moved(): readonly string[] {
        const { selection, subject } = this.#page.stores.view.getState();
        return subject.kind === "nodes" ? selection : [];
    }

    #targets(): readonly Target[] {
        const { document, schema } = this.#page.stores.document.getState();
        return document ? targetsOf(document, schema, this.#moved) : [];
    }

    /* As the picture shows it now: what moves hides nothing of it later. */
    #surface(projection: Projection): (spot: Spot) => Target | null {
        const { document } = this.#page.stores.document.getState();
        const guide = shownGuide(this.#page.stores.link.getState());
        const moved = this.#moved;
        return (spot) =>
            document && guide && surfaceUnder(document, guide, projection, moved, spot);
    }

    #projection(): Projection | null {
        const camera = shownCamera(this.#page.stores);
        return camera && projectionOf(camera, this.#size);
    }

    /* Of the one that is selected; none on top of the middle of the gizmo. */
    #handles(): readonly Handle[] {
        const { document, schema } = this.#page.stores.document.getState();
        const { selection, subject } = this.#page.stores.view.getState();
        const projection = this.#projection();
        const middle = this.#wholeParts().find(({ kind }) => kind === "middle");
        const all =
            document && projection
                ? handlesOf(document, schema, selection, subject, projection)
                : [];
        return middle?.kind === "middle"
            ? all.filter(
                  (handle) =>
                      isCorner(handle) ||
                      Math.hypot(handle.spot.x - middle.at.x, handle.spot.y - middle.at.y) >
                          NEAR_MIDDLE,
              )
            : all;
    }

    /* Beside the handles. */
    #parts(handles = this.#handles()): readonly Part[] {
        const spots = handles.map(({ spot }) => spot);
        return clearOf(this.#wholeParts(), spots);
    }

    #wholeParts(): readonly Part[] {
        const { tool, space, pivot } = this.#page.stores.view.getState().preferences.hands;
        const movables = this.#movables();
        const projection = this.#projection();
        const able = movables.some(({ motions }) => tool !== null && motions.includes(tool));
        if (tool === null || !able || projection === null) {
            return [];
        }
        const frame = frameOf(movables, space, tool);
        return gizmoParts({ pivot: pivotOf(movables, pivot), frame, projection }, tool);
    }

    readonly #redraw = (): void => {
        if (this.#drawing === 0) {
            this.#drawing = requestAnimationFrame(() => {
                this.#drawing = 0;
                this.#draw();
            });
        }
    };

    #draw(): void {
        const hold = this.#hold;
        const rest = hold === null ? this.#rest() : null;
        const was = this.#painted;
        this.#painted = rest === null || rest.handles.length + rest.parts.length > 0;
        const brush = was || this.#painted ? this.#clear() : null;
        if (brush !== null && hold !== null) {
            this.#drawHold(brush, hold);
        } else if (brush !== null && rest !== null) {
            this.#drawRest(brush, rest);
        }
    }

    #clear(): CanvasRenderingContext2D | null {
        const brush = this.#canvas.getContext("2d");
        const ratio = window.devicePixelRatio;
        if (!brush) {
            return null;
        }
        const [width, height] = [this.#size.width * ratio, this.#size.height * ratio].map(
            Math.round,
        );
        if (this.#canvas.width !== width || this.#canvas.height !== height) {
            this.#canvas.width = width ?? 1;
            this.#canvas.height = height ?? 1;
        }
        brush.setTransform(ratio, 0, 0, ratio, 0, 0);
        brush.clearRect(0, 0, this.#size.width, this.#size.height);
        return brush;
    }

    #rest(): Rest {
        const handles = this.#handles();
        return { handles, parts: this.#handle === null ? this.#parts(handles) : [] };
    }

    #drawRest(brush: CanvasRenderingContext2D, { handles, parts }: Rest): void {
        paintGizmo(brush, parts, this.#hot?.constraint ?? null);
        paintHandles(brush, handles, this.#handle?.key ?? this.#hotHandle);
        this.#corners.paint(brush, handles, this.#size.width);
        const hot = handles.find(({ key }) => key === this.#hotHandle);
        const label = this.#handle?.label ?? (hot ? handleLabel(hot) : "");
        paintLabel(brush, label, this.#handle?.at ?? hot?.spot ?? ORIGIN, this.#size.width);
        this.#tell(parts, handles);
    }

    /* The axis through the pivot across the picture, what is held, and how far. */
    #drawHold(brush: CanvasRenderingContext2D, hold: Hold): void {
        const { constraint, frame, pivot } = hold;
        const projection = this.#projection();
        if (projection === null) {
            return;
        }
        const guide = guideLine(projection, hold);
        if (guide !== null) {
            brush.globalAlpha = 0.8;
            stroke(brush, colorOf(constraint.axis), 1, () => line(brush, guide));
            brush.globalAlpha = 1;
        }
        const at = hold.delta?.motion === "move" ? add(pivot, hold.delta.by) : pivot;
        const parts = gizmoParts({ pivot: at, frame, projection }, constraint.motion);
        paintGizmo(brush, parts, constraint);
        const target = hold.target && projection.spotOf(hold.target.at);
        if (target) {
            ringAt(brush, target);
        }
        paintLabel(brush, hold.label, hold.pointer, this.#size.width);
        this.#tell(parts);
    }

    /* Where its parts are, for those who cannot see the pixels. */
    #tell(parts: readonly Part[], handles: readonly Handle[] = []): void {
        const places = parts.map((part) => ({ ...part.constraint, at: reachOf(part) }));
        const dots = handles.map(({ key, spot, look }) => ({
            handle: key,
            at: spot,
            look: look.kind,
        }));
        this.#canvas.dataset.parts = JSON.stringify([...places, ...dots]);
    }

    #listen(): void {
        const { document: scene, view, link, camera } = this.#page.stores;
        const listening = new AbortController();
        const options = { signal: listening.signal };
        const observer = new ResizeObserver(() => {
            const { clientWidth, clientHeight } = this.#element;
            this.#size = { width: Math.max(1, clientWidth), height: Math.max(1, clientHeight) };
            this.#redraw();
        });
        observer.observe(this.#element);
        window.addEventListener("pointermove", (event) => this.#hover(event), options);
        window.addEventListener("pointerdown", (event) => this.#pressOutside(event), {
            ...options,
            capture: true,
        });
        window.addEventListener("keydown", (event) => this.#key(event), {
            ...options,
            capture: true,
        });
        this.#stops.push(
            () => listening.abort(),
            () => observer.disconnect(),
            scene.subscribe(this.#redraw),
            link.subscribe((now, before) => now.frame !== before.frame && this.#redraw()),
            camera.subscribe(this.#redraw),
            view.subscribe((now, before) => {
                if (now.motion !== before.motion) {
                    this.#motion(now.motion);
                }
                if (now.selection !== before.selection) {
                    this.#corners.choose(null);
                }
                this.#redraw();
            }),
        );
    }
}

/* A point at which a part can be held. */
function reachOf(part: Part): Spot | null {
    switch (part.kind) {
        case "arrow":
        case "bar":
            return part.tip;
        case "square":
            return part.corners[0] ?? null;
        case "ring":
            return part.spots[part.front.indexOf(true)] ?? null;
        case "middle":
            return part.at;
    }
}

/* The part of the axis that lies in the picture, or null where there is none to show. */
function guideLine(projection: Projection, hold: Hold): readonly Spot[] | null {
    const { axis, plane } = hold.constraint;
    if (axis === null || plane) {
        return null;
    }
    const along = axisOf(hold.frame, axis);
    const far = projection.unitsAt(hold.pivot) * projection.size.width;
    const ends = [-far, -far / 4, far / 4, far].map((t) =>
        projection.spotOf(add(hold.pivot, scale(along, t))),
    );
    const seen = ends.filter((spot) => spot !== null);
    return seen.length > 1 ? seen : null;
}

/* Shift goes a tenth of the way; Ctrl turns snapping on, or off where it is on. */
export function keysOf(shift: boolean, ctrl: boolean, snaps: boolean): HoldKeys {
    return { fine: shift, snap: ctrl !== snaps };
}
