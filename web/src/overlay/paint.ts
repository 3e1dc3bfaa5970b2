/* SPDX-License-Identifier: MIT */
/* How hands look: everything is light on a dark halo, since the picture below has any colour. */

import { MIDDLE, type Part, type Shaft, sameConstraint } from "../model/gizmo.ts";
import type { Axis, Constraint } from "../model/grip.ts";
import type { Handle } from "../model/handles.ts";
import type { Spot } from "../model/projection.ts";

export type Brush = CanvasRenderingContext2D;

const AXIS_COLORS = ["#ff7b70", "#86dc7b", "#7fb0ff"] as const;
const FREE = "#f4f4f4";
const HOT = "#ffe08a";
const HALO = "rgb(0 0 0 / 45%)";
const LINE = 2.5;

export function colorOf(axis: Axis | null): string {
    return axis === null ? FREE : AXIS_COLORS[axis];
}

/* Strokes what `trace` draws, on a halo. */
export function stroke(brush: Brush, color: string, width: number, trace: () => void): void {
    brush.lineJoin = "round";
    brush.lineCap = "round";
    for (const [style, wide] of [
        [HALO, width + 2.5],
        [color, width],
    ] as const) {
        brush.beginPath();
        trace();
        brush.strokeStyle = style;
        brush.lineWidth = wide;
        brush.stroke();
    }
}

export function fill(brush: Brush, color: string, trace: () => void): void {
    brush.beginPath();
    trace();
    brush.strokeStyle = HALO;
    brush.lineWidth = 2.5;
    brush.stroke();
    brush.fillStyle = color;
    brush.fill();
}

export function line(brush: Brush, spots: readonly Spot[]): void {
    for (const [i, { x, y }] of spots.entries()) {
        brush[i === 0 ? "moveTo" : "lineTo"](x, y);
    }
}

export function dot(brush: Brush, at: Spot, radius: number, color: string): void {
    fill(brush, color, () => brush.arc(at.x, at.y, radius, 0, 2 * Math.PI));
}

/* Around what something was drawn to. */
export function ringAt(brush: Brush, { x, y }: Spot): void {
    brush.globalAlpha = 1;
    stroke(brush, HOT, 2, () => brush.arc(x, y, 9, 0, 2 * Math.PI));
}

/* --- parts of the gizmo --- */

function arrowHead(brush: Brush, foot: Spot, tip: Spot): void {
    const far = Math.hypot(tip.x - foot.x, tip.y - foot.y) || 1;
    const [dx, dy] = [(tip.x - foot.x) / far, (tip.y - foot.y) / far];
    brush.moveTo(tip.x + 8 * dx, tip.y + 8 * dy);
    brush.lineTo(tip.x - 6 * dx - 6 * dy, tip.y - 6 * dy + 6 * dx);
    brush.lineTo(tip.x - 6 * dx + 6 * dy, tip.y - 6 * dy - 6 * dx);
    brush.closePath();
}

function shaft(brush: Brush, part: Shaft, color: string, width: number): void {
    const { foot, tip } = part;
    stroke(brush, color, width, () => line(brush, [foot, tip]));
    fill(brush, color, () =>
        part.kind === "arrow"
            ? arrowHead(brush, foot, tip)
            : brush.rect(tip.x - 5.5, tip.y - 5.5, 11, 11),
    );
}

function ring(
    brush: Brush,
    part: Extract<Part, { kind: "ring" }>,
    color: string,
    width: number,
): void {
    brush.globalAlpha *= 0.3;
    stroke(brush, color, 1, () => line(brush, part.spots));
    brush.globalAlpha /= 0.3;
    stroke(brush, color, width, () => {
        for (const [i, { x, y }] of part.spots.entries()) {
            const joined = i > 0 && part.front[i - 1] && part.front[i];
            brush[joined ? "lineTo" : "moveTo"](x, y);
        }
    });
}

function paintPart(brush: Brush, part: Part, hot: boolean): void {
    const color = hot ? HOT : colorOf(part.constraint.axis);
    const width = hot ? LINE + 1 : LINE;
    switch (part.kind) {
        case "arrow":
        case "bar":
            shaft(brush, part, color, width);
            break;
        case "square":
            brush.globalAlpha *= hot ? 0.9 : 0.55;
            fill(brush, color, () => {
                line(brush, part.corners);
                brush.closePath();
            });
            brush.globalAlpha = 1;
            break;
        case "ring":
            ring(brush, part, color, part.constraint.axis === null ? width - 1 : width);
            break;
        case "middle":
            dot(brush, part.at, hot ? MIDDLE : MIDDLE - 2, color);
            break;
    }
}

export function paintGizmo(brush: Brush, parts: readonly Part[], hot: Constraint | null): void {
    for (const part of parts) {
        brush.globalAlpha = 1;
        paintPart(brush, part, sameConstraint(part.constraint, hot));
    }
}

/* --- handles of parameters --- */

const HANDLE = "#7ad8d2";
const HANDLE_RADIUS = 5;
const DASHES = [5, 5];

function paintLook(brush: Brush, { spot, look }: Handle, color: string, hot: boolean): void {
    const radius = hot ? HANDLE_RADIUS + 2 : HANDLE_RADIUS;
    const width = hot ? LINE + 1 : LINE;
    switch (look.kind) {
        case "arrow":
            stroke(brush, color, width, () => line(brush, [look.tail, spot]));
            fill(brush, color, () => arrowHead(brush, look.tail, spot));
            break;
        case "arc":
            stroke(brush, color, width - 0.5, () => line(brush, look.spots));
            dot(brush, spot, radius, color);
            break;
        case "band":
            brush.setLineDash(DASHES);
            stroke(brush, color, width - 1, () => {
                brush.arc(look.middle.x, look.middle.y, look.radius, 0, 2 * Math.PI);
                line(brush, [look.middle, spot]);
            });
            brush.setLineDash([]);
            dot(brush, spot, radius, color);
            break;
        case "place":
            fill(brush, color, () => {
                brush.moveTo(spot.x, spot.y - radius - 1);
                brush.lineTo(spot.x + radius + 1, spot.y);
                brush.lineTo(spot.x, spot.y + radius + 1);
                brush.lineTo(spot.x - radius - 1, spot.y);
                brush.closePath();
            });
            break;
        case "corner":
        case "dot":
            dot(brush, spot, radius, color);
            break;
    }
}

export function paintHandles(brush: Brush, handles: readonly Handle[], hot: string | null): void {
    brush.globalAlpha = 1;
    for (const { spot, look } of handles) {
        const next = look.kind === "corner" ? look.next : null;
        if (next) {
            stroke(brush, HANDLE, LINE - 1, () => line(brush, [spot, next]));
        }
    }
    for (const handle of handles) {
        paintLook(brush, handle, handle.key === hot ? HOT : HANDLE, handle.key === hot);
    }
}

/* A corner that there is not yet. */
export function paintSpare(brush: Brush, { x, y }: Spot): void {
    dot(brush, { x, y }, HANDLE_RADIUS + 3, HOT);
    stroke(brush, "#1c1c1c", 1.5, () => {
        line(brush, [
            { x: x - 4, y },
            { x: x + 4, y },
        ]);
        line(brush, [
            { x, y: y - 4 },
            { x, y: y + 4 },
        ]);
    });
}

/* --- words at the pointer --- */

const FONT = "600 12px system-ui, sans-serif";

export function paintLabel(brush: Brush, text: string, at: Spot, width: number): void {
    if (text === "") {
        return;
    }
    brush.font = FONT;
    const wide = brush.measureText(text).width + 16;
    const left = Math.min(at.x + 16, Math.max(0, width - wide - 4));
    brush.fillStyle = "rgb(18 18 18 / 82%)";
    brush.beginPath();
    brush.roundRect(left, at.y + 16, wide, 24, 6);
    brush.fill();
    brush.fillStyle = FREE;
    brush.textBaseline = "middle";
    brush.fillText(text, left + 8, at.y + 28.5);
}
