/* SPDX-License-Identifier: MIT */
/* One small drawing per node type on a 24 unit grid; a type without a row gets the diamond. The
 * first path is filled softly, all are stroked; `ghost` shows what an operation takes away. */
import { memo } from "react";
import "./glyph.css";

interface Drawing {
    body: string;
    lines?: string;
    ghost?: string;
}

const circles = "M9 6a6 6 0 1 0 0 12a6 6 0 1 0 0-12zM15 6a6 6 0 1 0 0 12a6 6 0 1 0 0-12z";
const right_circle = "M15 6a6 6 0 1 0 0 12a6 6 0 1 0 0-12z";

const drawings: Record<string, Drawing> = {
    sphere: {
        body: "M12 3.5a8.5 8.5 0 1 0 0 17a8.5 8.5 0 1 0 0-17z",
        lines: "M3.5 12c0 4 17 4 17 0",
    },
    ellipsoid: {
        body: "M12 6.5a9.5 5.5 0 1 0 0 11a9.5 5.5 0 1 0 0-11z",
        lines: "M2.5 12c0 2.8 19 2.8 19 0",
    },
    box: { body: "M12 3l8 4.5v9L12 21l-8-4.5v-9z", lines: "M4 7.5l8 4.5l8-4.5M12 12v9" },
    round_box: {
        body: "M10.5 3.8Q12 3 13.5 3.8L18.7 6.7Q20 7.5 20 9v6q0 1.5-1.3 2.3L13.5 20.2q-1.5.8-3 0L5.3 17.3Q4 16.5 4 15V9q0-1.5 1.3-2.3z",
        lines: "M4.6 7.6L10.5 11q1.5.9 3 0l5.9-3.4M12 11.6v9",
    },
    torus: {
        body: "M12 5.5a9.5 6.5 0 1 0 0 13a9.5 6.5 0 1 0 0-13z",
        lines: "M7.5 10.8q4.5 4.4 9 0M8.7 11.8q3.3-2.6 6.6 0",
    },
    cylinder: {
        body: "M5 6.5a7 2.8 0 0 1 14 0v11a7 2.8 0 0 1-14 0z",
        lines: "M5 6.5a7 2.8 0 0 0 14 0",
    },
    capsule: { body: "M7 8a5 5 0 0 1 10 0v8a5 5 0 0 1-10 0z", lines: "M7 8.5c0 2.4 10 2.4 10 0" },
    cone: { body: "M12 3l7 14.5a7 2.8 0 0 1-14 0z", lines: "M5 17.5c1-3.2 13-3.2 14 0" },
    plane: { body: "M2.5 17.5L8 10.5h13.5L16 17.5z", lines: "M12 14V4.5M9.5 7L12 4.5L14.5 7" },
    union: { body: "M12 6.8A6 6 0 1 0 12 17.2A6 6 0 1 0 12 6.8z" },
    intersection: { body: "M12 6.8A6 6 0 0 1 12 17.2A6 6 0 0 1 12 6.8z", ghost: circles },
    difference: { body: "M12 6.8A6 6 0 1 0 12 17.2A6 6 0 0 1 12 6.8z", ghost: right_circle },
    smooth_union: {
        body: "M8.5 6c2.2 0 2.2 1.8 3.5 1.8S13.3 6 15.5 6a6 6 0 0 1 0 12c-2.2 0-2.2-1.8-3.5-1.8S10.7 18 8.5 18a6 6 0 0 1 0-12z",
    },
    smooth_intersection: {
        body: "M12 8.2c1.8 0 2.6 1.9 2.6 3.8s-.8 3.8-2.6 3.8s-2.6-1.9-2.6-3.8s.8-3.8 2.6-3.8z",
        ghost: circles,
    },
    smooth_difference: {
        body: "M9 6c1.8 0 3 .5 3 1.7c0 1.5-2.2 1.6-2.2 4.3s2.2 2.8 2.2 4.3c0 1.2-1.2 1.7-3 1.7a6 6 0 0 1 0-12z",
        ghost: right_circle,
    },
    round: {
        body: "M10 4.5h4a5.5 5.5 0 0 1 5.5 5.5v4a5.5 5.5 0 0 1-5.5 5.5h-4A5.5 5.5 0 0 1 4.5 14v-4A5.5 5.5 0 0 1 10 4.5z",
        ghost: "M8 8h8v8H8z",
    },
    shell: {
        body: "M12 3.5a8.5 8.5 0 1 0 0 17a8.5 8.5 0 1 0 0-17zM12 7.5a4.5 4.5 0 1 1 0 9a4.5 4.5 0 1 1 0-9z",
    },
    mirror: { body: "M9 6v12l-6-3V9z", lines: "M15 6v12l6-3V9z", ghost: "M12 3v18" },
    repeat: {
        body: "M9.5 9.5h5v5h-5z",
        lines: "M3 9.5h3v5H3M21 9.5h-3v5h3M9.5 3v3h5V3M9.5 21v-3h5v3",
    },
    twist: {
        body: "M7 3h10c0 5-10 4-10 9s10 4 10 9H7c0-5 10-4 10-9S7 8 7 3z",
        lines: "M10 6.5h4M10 17.5h4",
    },
    group: {
        body: "M8.5 8.5h7v7h-7z",
        ghost: "M4 4h16v16H4z",
    },
};

const unknown: Drawing = { body: "M12 4l8 8l-8 8l-8-8z" };

export const glyphTypes = Object.keys(drawings);

interface Props {
    type: string;
    group?: string;
    size?: number;
}

export const Glyph = memo(function Glyph({ type, group, size = 16 }: Props) {
    const drawing = drawings[type] ?? unknown;
    return (
        <svg
            className="glyph"
            data-group={group}
            width={size}
            height={size}
            viewBox="0 0 24 24"
            aria-hidden="true"
        >
            {drawing.ghost && <path className="glyph-ghost" d={drawing.ghost} />}
            <path className="glyph-body" d={drawing.body} fillRule="evenodd" />
            {drawing.lines && <path d={drawing.lines} />}
        </svg>
    );
});
