/* SPDX-License-Identifier: MIT */
/* The line of a measurement. Placed outside of React, with the camera of the picture. */
import { useEffect, useRef } from "react";
import { projectionOf } from "../../model/projection.ts";
import type { Stores } from "../../model/stores.ts";
import type { Vector } from "../../model/transform.ts";
import { drawOver, shownCamera } from "../../overlay/shown.ts";
import { useEditor, useView } from "../state.ts";
import "./view.css";

/* Ends that are behind the camera take the line with them. */
function place(stores: Stores, drawing: SVGSVGElement, points: readonly Vector[]): void {
    const size = { width: drawing.clientWidth, height: drawing.clientHeight };
    const camera = shownCamera(stores);
    const projection = camera && projectionOf(camera, size);
    const spots = points.map((point) => projection?.spotOf(point) ?? null);
    const seen = spots.filter((spot) => spot !== null);
    drawing.dataset.shown = String(seen.length);
    const path = seen.map(({ x, y }) => `${x},${y}`).join(" ");
    for (const line of drawing.querySelectorAll("polyline")) {
        line.setAttribute("points", path);
    }
    for (const [i, end] of drawing.querySelectorAll("circle").entries()) {
        const spot = spots[i] ?? null;
        end.toggleAttribute("hidden", spot === null);
        end.setAttribute("cx", String(spot?.x ?? 0));
        end.setAttribute("cy", String(spot?.y ?? 0));
    }
}

export default function MeasuredLine() {
    const points = useView((view) => view.measured);
    return points !== null && points.length > 0 ? <Line points={points} /> : null;
}

function Line({ points }: { points: readonly Vector[] }) {
    const { stores } = useEditor();
    const drawing = useRef<SVGSVGElement>(null);
    useEffect(
        () => drawOver(stores, () => drawing.current && place(stores, drawing.current, points)),
        [stores, points],
    );
    return (
        <svg ref={drawing} className="measured-line" aria-hidden="true">
            <polyline className="measured-halo" />
            <polyline />
            {points.map((point) => (
                <circle key={point.join()} r="4" />
            ))}
        </svg>
    );
}
