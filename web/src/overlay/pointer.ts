/* SPDX-License-Identifier: MIT */
/* One state machine for everything that points at the picture: mouse, trackpad, touch, pen. It
 * turns gestures into cameras, clicks and menus. A drag is a function of the camera and pointer at
 * its start, so lost events cost nothing. Keys other than Space and Esc are commands. */
import { type Camera, dolly, orbit, type Pointer, pan } from "../model/camera.ts";
import type { Pointing, SelectMode } from "../model/view.ts";

export type Gesture = "orbit" | "pan" | "dolly";

/* Something in a hand. A press that does not become a drag is a click and starts nothing. */
export interface Holding {
    start(): void;
    move(press: Press): void;
    end(): void;
    cancel(): void;
}

/* What the machine asks of the page. Points are CSS pixels from the picture's left top. */
export interface PointerActions {
    /* A press on something that a hand can hold; "taken": it means something else, and nothing
     * follows; null: it is for the camera. */
    grab(press: Press): Holding | "taken" | null;
    camera(): Camera;
    moveCamera(camera: Camera): void;
    /* A click or tap. `list`: Alt was held, show all that is there. */
    click(x: number, y: number, mode: SelectMode, list: boolean): void;
    /* A right click or a long press. */
    menu(x: number, y: number): void;
    /* A double tap or double click: look at what is there. */
    frame(x: number, y: number): void;
    pointing(): Pointing;
    /* What turns the wheel of a mouse is a trackpad. */
    seemsTrackpad(): void;
    /* For the cursor and the status line; null: nothing is going on. */
    gesture(kind: Gesture | null): void;
}

/* The part of a PointerEvent that matters, with the place made relative to the picture. */
export interface Press {
    readonly id: number;
    readonly type: string;
    readonly button: number;
    readonly buttons: number;
    readonly x: number;
    readonly y: number;
    readonly shift: boolean;
    readonly ctrl: boolean;
    readonly alt: boolean;
    /* Milliseconds, any origin. */
    readonly at: number;
}

export interface Wheel {
    readonly x: number;
    readonly y: number;
    readonly dx: number;
    readonly dy: number;
    readonly shift: boolean;
    readonly ctrl: boolean;
}

/* Less movement than this is a click. */
const SLOP_MOUSE = 4;
const SLOP_TOUCH = 10;
const LONG_PRESS_MS = 500;
const DOUBLE_MS = 350;
const DOUBLE_PX = 24;
/* While a pen is near, touches are the palm. */
const PALM_MS = 700;
/* Distance factors per pixel of wheel, of pinch on a trackpad, of dragging. */
const WHEEL_RATE = 0.0015;
const PINCH_RATE = 0.01;
const DRAG_RATE = 0.005;

const LEFT = 0;
const MIDDLE = 1;
const RIGHT = 2;
const RIGHT_DOWN = 2; /* bit in `buttons` */

interface Spot {
    readonly x: number;
    readonly y: number;
}

/* Nothing pressed, pressed and not yet moved, holding something, moving the camera. */
type State =
    | { readonly kind: "idle" }
    | {
          readonly kind: "pressed";
          readonly press: Press;
          readonly long: boolean;
          readonly holding: Holding | null;
      }
    | { readonly kind: "holding"; readonly holding: Holding }
    | {
          readonly kind: "dragging";
          readonly gesture: Gesture;
          /* Where the base of the movement is; set anew when a finger comes or goes. */
          readonly start: Camera;
          readonly from: Spot;
          readonly span: number;
          /* What Esc goes back to. */
          readonly before: Camera;
          /* Where the movement is now; the camera is elsewhere once something else moves it. */
          readonly reached: Camera;
      };

export class PointerMachine {
    readonly #actions: PointerActions;
    #state: State = { kind: "idle" };
    #fingers = new Map<number, Spot>();
    #size = { width: 1, height: 1 };
    #space = false;
    #lastTap: Press | null = null;
    #penAt = Number.NEGATIVE_INFINITY;

    constructor(actions: PointerActions) {
        this.#actions = actions;
    }

    get dragging(): boolean {
        return this.#state.kind === "dragging";
    }

    resize(width: number, height: number): void {
        const before = this.#size;
        this.#size = { width: Math.max(1, width), height: Math.max(1, height) };
        const changed = before.width !== this.#size.width || before.height !== this.#size.height;
        if (changed && this.#state.kind === "dragging") {
            /* A pixel means another angle from now on, not on the way so far. */
            this.#startDrag(this.#state.gesture);
        }
    }

    setSpace(held: boolean): void {
        this.#space = held;
    }

    /* --- pressing --- */

    /* False: the press is a palm, or was taken, and is not to be captured. */
    down(press: Press): boolean {
        if (press.type === "pen") {
            this.#penAt = press.at;
        } else if (press.type === "touch" && press.at - this.#penAt < PALM_MS) {
            return false;
        }
        const grabbed = this.#fingers.size === 0 && !this.#space ? this.#actions.grab(press) : null;
        if (grabbed === "taken") {
            return false;
        }
        this.#fingers.set(press.id, press);
        if (this.#fingers.size === 1) {
            this.#state = { kind: "pressed", press, long: false, holding: grabbed };
        } else if (this.#state.kind !== "holding") {
            this.#startDrag("pan");
        }
        return true;
    }

    move(press: Press): void {
        if (press.type === "pen") {
            this.#penAt = press.at;
        }
        if (!this.#fingers.has(press.id)) {
            return;
        }
        if (this.#state.kind === "dragging" && this.#actions.camera() !== this.#state.reached) {
            /* A wheel or a key has moved it meanwhile: the drag goes on from there. */
            this.#startDrag(this.#state.gesture);
        }
        this.#fingers.set(press.id, press);
        if (this.#state.kind === "pressed") {
            const { press: first } = this.#state;
            const slop = press.type === "touch" ? SLOP_TOUCH : SLOP_MOUSE;
            if (Math.hypot(press.x - first.x, press.y - first.y) >= slop) {
                this.#leaveSlop(first, this.#state.holding);
            }
        }
        if (this.#state.kind === "holding") {
            this.#hold(press, this.#state.holding);
            return;
        }
        if (this.#state.kind === "dragging") {
            if (press.type === "mouse" && this.#cancelledBy(press)) {
                this.cancel();
            } else {
                this.#drag();
            }
        }
    }

    #leaveSlop(first: Press, holding: Holding | null): void {
        if (holding === null) {
            this.#startDrag(this.#gestureOf(first), first);
            return;
        }
        this.#state = { kind: "holding", holding };
        holding.start();
    }

    #hold(press: Press, holding: Holding): void {
        if (press.type === "mouse" && this.#cancelledBy(press)) {
            this.cancel();
        } else if (press.id === this.#fingers.keys().next().value) {
            holding.move(press);
        }
    }

    up(press: Press): void {
        if (!this.#fingers.delete(press.id)) {
            return;
        }
        if (this.#state.kind === "holding") {
            this.end();
            return;
        }
        if (this.#state.kind === "pressed" && !this.#state.long) {
            this.#tap(this.#state.press);
        }
        if (this.#state.kind === "dragging" && this.#fingers.size > 0) {
            /* The finger that stays goes on from here. */
            const { before } = this.#state;
            this.#startDrag("orbit", undefined, before);
            return;
        }
        if (this.#fingers.size === 0) {
            this.#rest();
        }
    }

    /* The button that was pressed did not move for LONG_PRESS_MS. A finger that rests on something it
     * can hold goes on to hold it. */
    held(): void {
        if (this.#state.kind === "pressed" && this.#state.press.type === "touch") {
            const { press, holding } = this.#state;
            this.#state = { kind: "pressed", press, long: true, holding };
            if (holding === null) {
                this.#actions.menu(press.x, press.y);
            }
        }
    }

    /* Focus, capture or pointer is gone: what was reached stays. */
    end(): void {
        this.#fingers.clear();
        this.#rest();
    }

    /* Goes back to where the gesture began; false where none is going on. */
    cancel(): boolean {
        const state = this.#state;
        const busy = state.kind !== "idle";
        if (state.kind === "dragging") {
            this.#actions.moveCamera(state.before);
        } else if (state.kind === "holding") {
            this.#state = { kind: "idle" };
            state.holding.cancel();
        }
        this.end();
        return busy;
    }

    #rest(): void {
        if (this.#state.kind === "dragging") {
            this.#actions.gesture(null);
        } else if (this.#state.kind === "holding") {
            this.#state.holding.end();
        }
        this.#state = { kind: "idle" };
    }

    /* A right click while another button drags. */
    #cancelledBy(press: Press): boolean {
        const others = press.buttons & ~RIGHT_DOWN;
        return (press.buttons & RIGHT_DOWN) !== 0 && others !== 0;
    }

    #gestureOf(first: Press): Gesture {
        if (first.button === RIGHT || (first.button === LEFT && this.#space)) {
            return "pan";
        }
        if (first.button === MIDDLE) {
            return first.shift ? "pan" : first.ctrl ? "dolly" : "orbit";
        }
        return "orbit";
    }

    #tap(press: Press): void {
        if (press.button === RIGHT) {
            this.#actions.menu(press.x, press.y);
            return;
        }
        if (press.button !== LEFT) {
            return;
        }
        const last = this.#lastTap;
        const again =
            last !== null &&
            press.at - last.at < DOUBLE_MS &&
            Math.hypot(press.x - last.x, press.y - last.y) < DOUBLE_PX;
        this.#lastTap = again ? null : press;
        if (again) {
            this.#actions.frame(press.x, press.y);
            return;
        }
        const mode = press.shift ? "add" : press.ctrl ? "toggle" : "replace";
        this.#actions.click(press.x, press.y, mode, press.alt);
    }

    /* --- dragging --- */

    #center(): Spot {
        const fingers = [...this.#fingers.values()];
        const sum = fingers.reduce((a, b) => ({ x: a.x + b.x, y: a.y + b.y }), { x: 0, y: 0 });
        const count = Math.max(1, fingers.length);
        return { x: sum.x / count, y: sum.y / count };
    }

    /* Mean distance of the fingers from their centre. */
    #span(): number {
        const center = this.#center();
        const fingers = [...this.#fingers.values()];
        const sum = fingers.reduce((s, f) => s + Math.hypot(f.x - center.x, f.y - center.y), 0);
        return sum / Math.max(1, fingers.length);
    }

    #startDrag(gesture: Gesture, from?: Spot, before?: Camera): void {
        const start = this.#actions.camera();
        const goesBackTo = this.#state.kind === "dragging" ? this.#state.before : start;
        this.#state = {
            kind: "dragging",
            gesture,
            start,
            from: from ?? this.#center(),
            span: this.#span(),
            before: before ?? goesBackTo,
            reached: start,
        };
        this.#actions.gesture(gesture);
    }

    #pointer(at: Spot): Pointer {
        return { x: at.x, y: at.y, ...this.#size };
    }

    #drag(): void {
        if (this.#state.kind !== "dragging") {
            return;
        }
        const { gesture, start, from, span } = this.#state;
        const to = this.#center();
        const [dx, dy] = [to.x - from.x, to.y - from.y];
        const { height } = this.#size;
        let camera = start;
        if (gesture === "orbit") {
            const turn = (2 * Math.PI) / height;
            camera = orbit(start, -dx * turn, dy * turn);
        } else if (gesture === "dolly") {
            camera = dolly(start, Math.exp(dy * DRAG_RATE), this.#pointer(from));
        } else {
            const now = this.#span();
            const factor = this.#fingers.size > 1 && now > 0 ? span / now : 1;
            camera = dolly(pan(start, dx, dy, height), factor, this.#pointer(to));
        }
        this.#state = { ...this.#state, reached: camera };
        this.#actions.moveCamera(camera);
    }

    /* --- wheel and trackpad --- */

    wheel({ x, y, dx, dy, shift, ctrl }: Wheel): void {
        const camera = this.#actions.camera();
        const trackpad = this.#actions.pointing() === "trackpad";
        /* No wheel turns both ways at once. */
        if (!trackpad && !ctrl && dx !== 0 && dy !== 0) {
            this.#actions.seemsTrackpad();
        }
        const { height } = this.#size;
        if (ctrl || !trackpad) {
            /* A pinch arrives as a wheel with Ctrl and small steps. */
            const rate = ctrl && Math.abs(dy) < 50 ? PINCH_RATE : WHEEL_RATE;
            /* Shift turns some browsers' wheel sideways. */
            const amount = dy === 0 && shift ? dx : dy;
            const factor = Math.exp(Math.min(300, Math.max(-300, amount)) * rate);
            this.#actions.moveCamera(dolly(camera, factor, this.#pointer({ x, y })));
        } else if (shift) {
            this.#actions.moveCamera(pan(camera, -dx, -dy, height));
        } else {
            const turn = (2 * Math.PI) / height;
            this.#actions.moveCamera(orbit(camera, dx * turn, -dy * turn));
        }
    }
}

const LINE_PX = 16;

function isTyping(target: EventTarget | null): boolean {
    return (
        target instanceof HTMLElement &&
        (target.isContentEditable || target.matches("input, textarea, select, button, a"))
    );
}

/* Connects a machine to the picture's element; the function answered disconnects it. */
export function attachPointer(element: HTMLElement, actions: PointerActions): () => void {
    const machine = new PointerMachine(actions);
    const stop = new AbortController();
    const options = { signal: stop.signal };
    let timer: ReturnType<typeof setTimeout> | undefined;

    const place = (event: MouseEvent): Spot => {
        const box = element.getBoundingClientRect();
        machine.resize(box.width, box.height);
        return { x: event.clientX - box.left, y: event.clientY - box.top };
    };
    const press = (event: PointerEvent): Press => ({
        ...place(event),
        id: event.pointerId,
        type: event.pointerType,
        button: event.button,
        buttons: event.buttons,
        shift: event.shiftKey,
        ctrl: event.ctrlKey || event.metaKey,
        alt: event.altKey,
        at: event.timeStamp,
    });

    const onDown = (event: PointerEvent): void => {
        if (!machine.down(press(event))) {
            return;
        }
        element.setPointerCapture(event.pointerId);
        element.focus({ preventScroll: true });
        event.preventDefault();
        clearTimeout(timer);
        timer = setTimeout(() => machine.held(), LONG_PRESS_MS);
    };
    const onUp = (event: PointerEvent): void => {
        clearTimeout(timer);
        machine.up(press(event));
    };
    const onWheel = (event: WheelEvent): void => {
        event.preventDefault();
        const unit = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : LINE_PX;
        machine.wheel({
            ...place(event),
            dx: event.deltaX * unit,
            dy: event.deltaY * unit,
            shift: event.shiftKey,
            ctrl: event.ctrlKey || event.metaKey,
        });
    };
    const onKey = (event: KeyboardEvent): void => {
        const down = event.type === "keydown";
        if (event.code === "Space") {
            const typing = isTyping(event.target);
            machine.setSpace(down && !typing);
            if (!typing && element.contains(document.activeElement)) {
                event.preventDefault();
            }
        }
        if (down && event.key === "Escape" && machine.cancel()) {
            event.preventDefault();
            event.stopImmediatePropagation();
        }
    };

    element.style.touchAction = "none";
    element.addEventListener("pointerdown", onDown, options);
    element.addEventListener("pointermove", (event) => machine.move(press(event)), options);
    element.addEventListener("pointerup", onUp, options);
    element.addEventListener("pointercancel", () => machine.end(), options);
    element.addEventListener("lostpointercapture", onUp, options);
    /* Else its click goes to what a tap has brought below the finger. */
    const onTouchEnd = (event: TouchEvent): void => {
        if (event.cancelable) {
            event.preventDefault();
        }
    };
    element.addEventListener("touchend", onTouchEnd, { ...options, passive: false });
    element.addEventListener("wheel", onWheel, { ...options, passive: false });
    element.addEventListener("contextmenu", (event) => event.preventDefault(), options);
    window.addEventListener("keydown", onKey, { ...options, capture: true });
    window.addEventListener("keyup", onKey, { ...options, capture: true });
    window.addEventListener(
        "blur",
        () => {
            /* It may be let go where nobody is told. */
            machine.setSpace(false);
            machine.end();
        },
        options,
    );
    return () => {
        clearTimeout(timer);
        machine.end();
        stop.abort();
    };
}
