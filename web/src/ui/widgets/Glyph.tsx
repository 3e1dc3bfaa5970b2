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
const disc = (x: number, y: number, r: number): string =>
    `M${x} ${y - r}a${r} ${r} 0 1 0 0 ${2 * r}a${r} ${r} 0 1 0 0 ${-2 * r}z`;
const dots = (...at: readonly (readonly [number, number])[]): string =>
    at.map(([x, y]) => disc(x, y, 2)).join("");
const rough =
    "M12 4c1.5 0 1.5 1.5 3 1.6s2 1.7 2.6 2.6s1.9 1 1.9 2.3s-.8 1.3-.8 2.8s-.5 1.7-1.5 2.6s-1 2-2.5 2.2s-1.7.9-2.7.9s-1.3-.7-2.7-.9s-1.6-1.2-2.5-2.2s-1.5-1.1-1.5-2.6s-.8-1.6-.8-2.8s1.3-1.4 1.9-2.3S7.5 5.7 9 5.6S10.5 4 12 4z";

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
    box_frame: {
        body: "M12 3l8 4.5v9L12 21l-8-4.5v-9zM12 7l4.5 2.6v4.8L12 17l-4.5-2.6V9.6z",
        lines: "M4 7.5l3.5 2.1M20 7.5l-3.5 2.1M12 17v4",
    },
    capped_torus: {
        body: "M4 17a2 2 0 0 1-1-2a9 9 0 0 1 18 0a2 2 0 0 1-4 0a5 5 0 0 0-10 0a2 2 0 0 1-3 2z",
    },
    link: {
        body: "M12 3a5 5 0 0 1 5 5v8a5 5 0 0 1-10 0V8a5 5 0 0 1 5-5zM12 6.5A1.5 1.5 0 0 0 10.5 8v8a1.5 1.5 0 0 0 3 0V8A1.5 1.5 0 0 0 12 6.5z",
    },
    round_cylinder: {
        body: "M5 8.5c0-3 3-3.8 7-3.8s7 .8 7 3.8v7c0 3-3 3.8-7 3.8s-7-.8-7-3.8z",
        lines: "M5.6 9c1.5 2 11.3 2 12.8 0",
    },
    capped_cone: {
        body: "M9 5a3 1.3 0 0 1 6 0l4 12.5a7 2.8 0 0 1-14 0z",
        lines: "M9 5a3 1.3 0 0 0 6 0",
    },
    round_cone: { body: "M9.2 6a3 3 0 0 1 5.6 0l3 7.7a6.2 6.2 0 1 1-11.6 0z" },
    solid_angle: { body: "M12 20.5L5 8a8.4 8.4 0 0 1 14 0z", lines: "M5 8c2 2.6 12 2.6 14 0" },
    cut_sphere: {
        body: "M4 14.5a8.2 8.2 0 0 1 16 0a8 2.6 0 0 1-16 0z",
        lines: "M4 14.5a8 2.6 0 0 1 16 0",
    },
    cut_hollow_sphere: {
        body: "M4 9.5a8.2 8.2 0 0 0 16 0a8 2.6 0 0 0-16 0z",
        lines: "M4 9.5a8 2.6 0 0 0 16 0",
    },
    death_star: { body: "M14.5 3.9A8.5 8.5 0 1 0 14.5 20.1A9.5 9.5 0 0 1 14.5 3.9z" },
    hex_prism: {
        body: "M7 5h7l3.5 6L14 17H7l-3.5-6z",
        lines: "M14 5l3 2.5l3.5 6l-3.5 6h-7l-3-2.5",
    },
    tri_prism: { body: "M10 4l6.5 11.5h-13z", lines: "M10 4l4 3l6.5 11.5h-13l-4-3M16.5 15.5l4 3" },
    octahedron: { body: "M12 3l8 9l-8 9l-8-9z", lines: "M4 12l8 2.5l8-2.5" },
    tetrahedron: { body: "M12 3.5l9 15H3z", lines: "M12 3.5l2.5 10.5l6.5 4.5M14.5 14L3 18.5" },
    dodecahedron: {
        body: "M12 3l5.3 1.7L20.6 9v6l-3.3 4.3L12 21l-5.3-1.7L3.4 15V9l3.3-4.3z",
        lines: "M12 7.5l4.4 3.2l-1.7 5.1H9.3l-1.7-5.1z",
    },
    icosahedron: { body: "M12 3l8 4.5v9L12 21l-8-4.5v-9z", lines: "M12 7.5l4.5 7.5h-9z" },
    pyramid: { body: "M12 3l9 12.5l-9 5.5l-9-5.5z", lines: "M12 3v18" },
    rhombus: { body: "M12 7l9 4.5l-9 4.5l-9-4.5z", lines: "M3 11.5v2.5l9 4.5l9-4.5v-2.5" },
    triangle: { body: "M5 5l15 6L8 19z" },
    quad: { body: "M5 6l13-2l2 12L7 20z" },
    implicit: {
        body: "M3.5 8C8 3.5 11 12 20.5 6v10c-9 6-12.5-3-17 2z",
        lines: "M8.5 9.5l6 5.5M14.500 9.5l-6 5.5",
    },
    parametric: {
        body: "M3.5 9C8 3.5 13 11 20.5 5.5v10C13 21 8 13.5 3.5 19z",
        lines: "M9 7.5v9.5M14.5 8v10M3.5 14C8 8.5 13 16 20.5 10.5",
    },
    gyroid: { body: "M4 7c4-5 5 4 8 0s4-4 8-1v11c-4-3-5-2-8 1s-4-4-8 0z" },
    mandelbulb: {
        body: "M12 4a4 4 0 0 1 3.6 2.3a4 4 0 0 1 3 6.7a4 4 0 0 1-4 5.6a4 4 0 0 1-5.2 0a4 4 0 0 1-4-5.6a4 4 0 0 1 3-6.7A4 4 0 0 1 12 4z",
    },
    menger: { body: "M4 4h16v16H4zM9.3 9.3h5.4v5.4H9.3z" },
    julia: { body: "M4 13c0-5 5-5 6-2s4 3 4-1s6-4 6 2s-5 5-6 2s-4-3-4 1s-6 3-6-2z" },
    terrain: { body: "M2.5 18l6-9l4 5l3-4l6 8z" },
    circle: { body: disc(12, 12, 8) },
    rectangle: { body: "M3.5 7h17v10h-17z" },
    round_rectangle: {
        body: "M7.5 7h9a4 4 0 0 1 4 4v2a4 4 0 0 1-4 4h-9a4 4 0 0 1-4-4v-2a4 4 0 0 1 4-4z",
    },
    triangle2: { body: "M12 4.5l8 14H4z" },
    regular_polygon: { body: "M12 3.5l7.5 4.3v8.4L12 20.5l-7.5-4.3V7.8z" },
    polygon: { body: "M4 8l7-4l3 5l6 1l-4 9l-9 1z" },
    star: { body: "M12 3l2.4 6h6.3l-5 4l1.9 6.3L12 15.5l-5.6 3.8L8.3 13l-5-4h6.3z" },
    ring: { body: disc(12, 12, 8.5) + disc(12, 12, 4.5) },
    arc: { body: "M4.5 16a8 8 0 1 1 15 0l-3.5-1.3a4.3 4.3 0 1 0-8 0z" },
    vesica: { body: "M12 3c5 4 5 14 0 18c-5-4-5-14 0-18z" },
    cross: { body: "M9.5 3.5h5v6h6v5h-6v6h-5v-6h-6v-5h6z" },
    bezier: { body: "M3.5 15.5C8 15.5 9 4.5 20.5 5.5v3.4C11 8 12 18.5 3.5 18.5z" },
    heart: { body: "M12 20C4 14 3.5 9 5.5 6.5s5.5-1.5 6.5 1.5c1-3 4.5-4 6.5-1.5S20 14 12 20z" },
    ellipse: { body: "M12 7a9 5 0 1 0 0 10a9 5 0 1 0 0-10z" },
    segment: { body: "M5.6 16.2l10-10a1.6 1.6 0 0 1 2.3 2.3l-10 10a1.6 1.6 0 0 1-2.3-2.3z" },
    exclusive: { body: circles },
    morph: { body: `M3.5 8.5h6v7h-6z${disc(18, 12, 3.5)}`, lines: "M11.2 12h2.3" },
    elongate: { body: "M8 7h8a5 5 0 0 1 0 10H8A5 5 0 0 1 8 7z", ghost: "M9.5 7v10M14.5 7v10" },
    bend: { body: "M3 17a9 9 0 0 1 18 0h-5a4 4 0 0 0-8 0z" },
    displace: { body: rough },
    displace_noise: { body: rough, lines: "M9 10h.01M13 9h.01M15 13h.01M10 14h.01" },
    offset_space: { body: "M5 6c3-2 4 2 7 0s4 2 7 0v12c-3 2-4-2-7 0s-4-2-7 0z" },
    repeat_polar: { body: dots([12, 5], [18, 8.5], [18, 15.5], [12, 19], [6, 15.5], [6, 8.5]) },
    extrude: { body: "M4 9h9v11H4z", lines: "M4 9l6-5h9v11l-6 5M13 9l6-5" },
    revolve: {
        body: "M12 3.5c4.5 1 6 5 3.5 8.5s0 6.5 3 8h-13c3-1.5 5.5-4.5 3-8s-1-7.5 3.5-8.5z",
        ghost: "M12 3.5v16.5",
    },
    material: {
        body: "M12 3.5a8.5 8.5 0 1 0 0 17c1.8 0 2-1.5 1.3-2.5s0-2.5 1.7-2.5h2.5a3 3 0 0 0 3-3.5a8.5 8.5 0 0 0-8.5-8.5z",
        lines: "M8 11h.01M12 8h.01M16 10h.01",
    },
    model: {
        body: "M12 3l3 3l-3 3l-3-3zM12 15l3 3l-3 3l-3-3zM6 9l3 3l-3 3l-3-3zM18 9l3 3l-3 3l-3-3z",
    },
    field: {
        body: "M6 4h12a2 2 0 0 1 2 2v12a2 2 0 0 1-2 2H6a2 2 0 0 1-2-2V6a2 2 0 0 1 2-2z",
        lines: "M9 17c2.5 0 2.5-2 2.7-5s.3-5 2.8-5M9.5 11.5h5",
    },
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
