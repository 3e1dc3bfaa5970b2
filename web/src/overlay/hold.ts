/* SPDX-License-Identifier: MIT */
/* A hand that holds what is selected, from taking hold to letting go: one undo step. Driven by the
 * pointer, or by digits. */
import type { Constraint, Delta, Grip, Motion } from "../model/grip.ts";
import { deltaOf, deltaTo, SNAP } from "../model/grip.ts";
import type { Pivot, Space } from "../model/hands.ts";
import { frameOf, type Movable, motionOps } from "../model/movables.ts";
import type { Operation } from "../model/operation.ts";
import type { Projection, Spot } from "../model/projection.ts";
import { type Snapped, snapTo, type Target } from "../model/snapping.ts";
import { length, type Matrix, subtract, type Vector } from "../model/transform.ts";
import { fromShown, parseNumber, shortNumber, toShown } from "../model/units.ts";

/* What the link offers for one undo step. */
export interface Step {
    edit(ops: readonly Operation[]): boolean;
    end(): void;
    cancel(): void;
}

export interface HoldKeys {
    /* A tenth of the way. */
    readonly fine: boolean;
    readonly snap: boolean;
}

export interface HoldStart {
    readonly movables: readonly Movable[];
    readonly pivot: Vector;
    readonly mode: Pivot;
    readonly space: Space;
    readonly projection: Projection;
    readonly from: Spot;
    readonly constraint: Constraint;
    readonly step: Step;
    /* What a move may be drawn to while it snaps. */
    readonly targets: () => readonly Target[];
    /* The surface at a point of the picture, which a free move may set it on. */
    readonly surface: (spot: Spot) => Target | null;
}

const FINE = 0.1;
/* What may be typed: a number or one line of arithmetic. */
const TYPED = /^[0-9.,+\-*/() ]$/;

export class Hold {
    readonly #start: HoldStart;
    #constraint: Constraint;
    #space: Space;
    /* Where the pointer is, and where a hand would be that goes a tenth of the way while fine. */
    #pointer: Spot;
    #hand: Spot;
    #keys: HoldKeys = { fine: false, snap: false };
    #turned = 0;
    #typed = "";
    #delta: Delta | null = null;
    #targets: readonly Target[] | null = null;
    #target: Target | null = null;

    constructor(start: HoldStart) {
        this.#start = start;
        this.#constraint = start.constraint;
        this.#space = start.space;
        this.#pointer = start.from;
        this.#hand = start.from;
    }

    get constraint(): Constraint {
        return this.#constraint;
    }

    get pointer(): Spot {
        return this.#pointer;
    }

    get frame(): Matrix {
        return frameOf(this.#start.movables, this.#space, this.#constraint.motion);
    }

    get pivot(): Vector {
        return this.#start.pivot;
    }

    get grip(): Grip {
        const { pivot, projection, from } = this.#start;
        return { constraint: this.#constraint, pivot, frame: this.frame, projection, from };
    }

    get delta(): Delta | null {
        return this.#delta;
    }

    /* What it was drawn to. */
    get target(): Target | null {
        return this.#target;
    }

    to(spot: Spot, keys: HoldKeys): void {
        this.#hand = handAfter(this.#hand, this.#pointer, spot, keys.fine);
        this.#pointer = spot;
        this.#keys = keys;
        if (this.#typed === "") {
            this.#apply();
        }
    }

    /* An axis again: along its own axis, then free. `plane`: along both others. */
    constrain(axis: 0 | 1 | 2, plane: boolean): void {
        const now = this.#constraint;
        const same = now.axis === axis && now.plane === plane;
        const local = this.#space === "local" || now.motion === "scale";
        this.#constraint =
            same && local ? { ...now, axis: null, plane: false } : { ...now, axis, plane };
        this.#space = same ? (local ? this.#start.space : "local") : this.#space;
        this.#turned = 0;
        const still = deltaOf(this.grip, now.motion === "scale" ? 1 : 0);
        this.#apply(this.#delta && still);
    }

    /* A character of a number, or "Backspace". False: it means nothing here. */
    type(key: string): boolean {
        if (key === "Backspace") {
            this.#typed = this.#typed.slice(0, -1);
        } else if (TYPED.test(key)) {
            this.#typed += key;
        } else {
            return false;
        }
        this.#apply();
        return true;
    }

    end(): void {
        this.#start.step.end();
    }

    cancel(): void {
        this.#start.step.cancel();
    }

    /* "X 0.5", "30°": what was done so far; what was typed with a mark behind. */
    get label(): string {
        const { axis, plane } = this.#constraint;
        const letters =
            axis === null ? "" : plane ? "XYZ".replace("XYZ"[axis] ?? "", "") : "XYZ"[axis];
        const amount = this.#typed === "" ? amountOf(this.#delta, this.grip) : `${this.#typed}▏`;
        const target = this.#target ? `· ${this.#target.name}` : "";
        return [letters, amount, target].filter(Boolean).join(" ");
    }

    /* `otherwise`: where the hand or the number means nothing; null: what was done so far. */
    #apply(otherwise: Delta | null = null): void {
        this.#target = null;
        const delta = (this.#typed === "" ? this.#byHand() : this.#byNumber()) ?? otherwise;
        if (delta === null) {
            return;
        }
        this.#delta = delta;
        const { movables, pivot, mode, step } = this.#start;
        const ops = motionOps(movables, delta, pivot, this.frame, mode);
        if (ops.length > 0) {
            step.edit(ops);
        }
    }

    /* Null where the hand means nothing: what was done so far stays. */
    #byHand(): Delta | null {
        const step = this.#keys.snap ? SNAP[this.#constraint.motion] : 0;
        const delta = deltaTo(this.grip, this.#hand, step, this.#turned);
        this.#turned = delta?.motion === "turn" ? delta.angle : 0;
        return step > 0 && delta?.motion === "move" ? this.#drawn(delta) : delta;
    }

    /* To the middle of another shape where that is near, else to the surface under the pointer, else
     * in steps. */
    #drawn(stepped: Delta): Delta {
        const free = deltaTo(this.grip, this.#hand, 0, 0);
        this.#targets ??= this.#start.targets();
        const near = free?.motion === "move" ? snapTo(this.grip, free.by, this.#targets) : null;
        const snapped = near ?? this.#onSurface();
        this.#target = snapped?.target ?? null;
        return snapped ? { motion: "move", by: snapped.by } : stepped;
    }

    /* The origin of the active one goes there. */
    #onSurface(): Snapped | null {
        const origin = this.#start.movables.at(-1)?.origin;
        const target = this.#constraint.axis === null ? this.#start.surface(this.#pointer) : null;
        return origin && target ? { target, by: subtract(target.at, origin) } : null;
    }

    /* Null while what was typed is no number yet. */
    #byNumber(): Delta | null {
        const shown = parseNumber(this.#typed, 0);
        const unit = this.#constraint.motion === "turn" ? "angle" : null;
        const isFactor = this.#constraint.motion === "scale" && shown !== null && shown <= 0;
        return shown === null || isFactor ? null : deltaOf(this.grip, fromShown(shown, unit));
    }
}

/* Where a hand is that goes the pointer's way, or a tenth of it. */
export function handAfter(hand: Spot, from: Spot, to: Spot, fine: boolean): Spot {
    const rate = fine ? FINE : 1;
    return { x: hand.x + (to.x - from.x) * rate, y: hand.y + (to.y - from.y) * rate };
}

function amountOf(delta: Delta | null, { constraint, frame }: Grip): string {
    switch (delta?.motion) {
        case "move": {
            const { axis, plane } = constraint;
            if (axis === null || plane) {
                return shortNumber(length(delta.by));
            }
            return shortNumber(
                frame.reduce((sum, row, i) => sum + row[axis] * (delta.by[i] ?? 0), 0),
            );
        }
        case "turn":
            return `${shortNumber(toShown(delta.angle, "angle"))}°`;
        case "scale":
            return `× ${shortNumber(delta.factors.find((factor) => factor !== 1) ?? 1)}`;
        default:
            return "";
    }
}

/* What a step of undo is called. */
export const STEP_NAMES: Readonly<Record<Motion, string>> = {
    move: "move",
    turn: "rotate",
    scale: "scale",
};
