/* SPDX-License-Identifier: MIT */
/* The ground as lines of the plane y = 0, as they are seen: each tenth one is stronger, they fade with
 * the distance and where they are dense, and surfaces hide them. */
import { axes, type Camera, distance } from "./camera.ts";
import type { Axis } from "./grip.ts";
import type { Size } from "./projection.ts";
import { dot, subtract, type Vector } from "./transform.ts";

/* Lines of one look: x, y, x, y of each piece, in CSS pixels. `axis`: it is the line of that axis. */
export interface GridStroke {
    readonly axis: Axis | null;
    /* 0 to 1. */
    readonly strength: number;
    readonly pieces: readonly number[];
}

/* Lines a step apart, in scene units. */
interface Level {
    readonly step: number;
    readonly strength: number;
}

/* A camera at this many units from its target sees lines of 1 unit; ten times as far, none. */
const FULL = 4;
const MINOR = 0.55;

/* As the camera goes away, one level after the other fades, and none jumps. */
export function levelsOf(camera: Camera): readonly Level[] {
    const far = Math.log10(reachOf(camera) / FULL);
    const least = Math.floor(far);
    const gone = (far - least) ** 2;
    return [
        { step: 10 ** least, strength: MINOR * (1 - gone) },
        { step: 10 ** (least + 1), strength: 1 - (1 - MINOR) * gone },
        { step: 10 ** (least + 2), strength: 1 },
    ];
}

/* Scene units: about how far what matters is. */
function reachOf(camera: Camera): number {
    return camera.height === null
        ? Math.max(distance(camera), Math.abs(camera.position[1]))
        : 1.2 * camera.height;
}

/* --- lines as the camera sees them --- */

/* A number that is even along a line: at its start, and for each unit. */
type Even = readonly [number, number];

interface Lens {
    readonly camera: Camera;
    readonly size: Size;
    readonly right: Vector;
    readonly up: Vector;
    readonly forward: Vector;
    /* Half of the picture's height: of what is one unit away, or in scene units. */
    readonly half: number;
    readonly near: number;
}

function lensOf(camera: Camera, size: Size): Lens {
    const half =
        camera.height === null ? Math.tan((camera.fov * Math.PI) / 360) : camera.height / 2;
    const near = camera.height === null ? 0.01 * reachOf(camera) : Number.NEGATIVE_INFINITY;
    return { camera, size, half, near, ...axes(camera) };
}

/* A line of the plane: the place where the other coordinate is 0. */
interface Line {
    readonly from: Vector;
    readonly along: 0 | 2;
}

interface Seen {
    readonly x: Even;
    readonly y: Even;
    readonly z: Even;
}

function seenLine({ camera, right, up, forward }: Lens, { from, along }: Line): Seen {
    const apart = subtract(from, camera.position);
    const even = (axis: Vector): Even => [dot(apart, axis), axis[along]];
    return { x: even(right), y: even(up), z: even(forward) };
}

/* The part of an interval in which something is not negative; it may be empty. */
function clip([low, high]: Even, [at, rate]: Even): Even {
    if (rate === 0) {
        return at < 0 ? [0, 0] : [low, high];
    }
    const zero = -at / rate;
    return rate > 0 ? [Math.max(low, zero), high] : [low, Math.min(high, zero)];
}

/* What of an interval is in the picture, before the camera. */
function inPicture({ camera, size, half, near }: Lens, { x, y, z }: Seen, all: Even): Even {
    const depth: Even = camera.height === null ? z : [1, 0];
    const side = (half * size.width) / size.height;
    const room = (axis: Even, reach: number, sign: number): Even => [
        depth[0] * reach + sign * axis[0],
        depth[1] * reach + sign * axis[1],
    ];
    const bounds: Even[] = [room(x, side, 1), room(x, side, -1), room(y, half, 1)];
    bounds.push(room(y, half, -1));
    if (camera.height === null) {
        bounds.push([z[0] - near, z[1]]);
    }
    return bounds.reduce(clip, all);
}

/* --- pieces --- */

/* A piece of a line in the picture: both ends, and how far along the camera's axis they are. */
interface Piece {
    readonly ax: number;
    readonly ay: number;
    readonly az: number;
    readonly bx: number;
    readonly by: number;
    readonly bz: number;
}

function pieceOf({ camera, size, half }: Lens, { x, y, z }: Seen, [low, high]: Even): Piece {
    const scale = size.height / (2 * half);
    const [az, bz] = [z[0] + low * z[1], z[0] + high * z[1]];
    const [a, b] = camera.height === null ? [scale / az, scale / bz] : [scale, scale];
    const [cx, cy] = [size.width / 2, size.height / 2];
    return {
        ax: cx + (x[0] + low * x[1]) * a,
        ay: cy - (y[0] + low * y[1]) * a,
        az,
        bx: cx + (x[0] + high * x[1]) * b,
        by: cy - (y[0] + high * y[1]) * b,
        bz,
    };
}

/* Pixels between two lines a unit apart that lie across the view, at a distance from the eye. */
function spacing({ camera, size, half, forward }: Lens, far: number): number {
    const pixels = size.height / (2 * half);
    return camera.height === null
        ? (pixels * Math.abs(camera.position[1])) / (far * far)
        : pixels * Math.abs(forward[1]);
}

/* Pixels apart at which lines begin to be seen, and are seen fully. */
const DENSE = 3;
const CLEAR = 18;
/* How far lines go: times the reach of the camera, and steps of their level. */
const REACH = 6;
const MOST_STEPS = 26;
/* A line of full length has so many pieces; looks differ by so many strengths. */
const PIECES = 14;
const LOOKS = 24;

function strengthAt(lens: Lens, step: number, radius: number, middle: Vector, at: Vector): number {
    const out = Math.hypot(at[0] - middle[0], at[2] - middle[2]) / radius;
    const far = Math.hypot(...subtract(at, lens.camera.position));
    const apart = (step * spacing(lens, far) - DENSE) / (CLEAR - DENSE);
    return Math.max(0, 1 - out * out) * Math.min(1, Math.max(0, apart));
}

/* --- what surfaces hide --- */

/* Whether the ground at a distance from the eye is seen at a point of the picture. */
export type Visible = (x: number, y: number, far: number) => boolean;

/* Pixels between two looks along a line; where they differ, the edge is found to a part of that. */
const LOOK = 4;
const HALVINGS = 3;

function addVisible(
    to: number[],
    { camera, size, half }: Lens,
    piece: Piece,
    sees: Visible | null,
): void {
    const { ax, ay, az, bx, by, bz } = piece;
    if (sees === null) {
        to.push(ax, ay, bx, by);
        return;
    }
    const scale = (2 * half) / size.height;
    const seen = (t: number): boolean => {
        const [x, y] = [ax + t * (bx - ax), ay + t * (by - ay)];
        if (camera.height !== null) {
            return sees(x, y, az + t * (bz - az));
        }
        const [u, v] = [(x - size.width / 2) * scale, (y - size.height / 2) * scale];
        return sees(x, y, Math.sqrt(1 + u * u + v * v) / ((1 - t) / az + t / bz));
    };
    const add = (a: number, b: number): void => {
        to.push(ax + a * (bx - ax), ay + a * (by - ay), ax + b * (bx - ax), ay + b * (by - ay));
    };
    const count = Math.max(1, Math.ceil(Math.hypot(bx - ax, by - ay) / LOOK));
    let [before, start] = [seen(0), 0];
    for (let i = 1; i <= count; i++) {
        const now = seen(i / count);
        if (now !== before) {
            const edge = edgeBetween((i - 1) / count, i / count, before, seen);
            if (before) {
                add(start, edge);
            }
            [before, start] = [now, edge];
        }
    }
    if (before) {
        add(start, 1);
    }
}

function edgeBetween(a: number, b: number, first: boolean, seen: (t: number) => boolean): number {
    let [low, high] = [a, b];
    for (let i = 0; i < HALVINGS; i++) {
        const middle = (low + high) / 2;
        [low, high] = seen(middle) === first ? [middle, high] : [low, middle];
    }
    return (low + high) / 2;
}

/* --- all of it --- */

interface Looks {
    of(axis: Axis | null, strength: number): number[] | null;
    strokes(): readonly GridStroke[];
}

function newLooks(): Looks {
    const all = new Map<string, GridStroke & { pieces: number[] }>();
    return {
        of(axis, strength) {
            const look = Math.round(strength * LOOKS);
            const key = `${axis} ${look}`;
            if (look > 0 && !all.has(key)) {
                all.set(key, { axis, strength: look / LOOKS, pieces: [] });
            }
            return all.get(key)?.pieces ?? null;
        },
        strokes: () => [...all.values()].filter(({ pieces }) => pieces.length > 0),
    };
}

/* The ground around a place, seen through a lens. */
interface Ground {
    readonly lens: Lens;
    readonly middle: Vector;
    readonly sees: Visible | null;
    readonly looks: Looks;
}

function radiusOf({ lens }: Ground, { step }: Level): number {
    return Math.min(REACH * reachOf(lens.camera), MOST_STEPS * step);
}

function addLine(ground: Ground, level: Level, line: Line, axis: Axis | null): void {
    const { lens, middle, sees, looks } = ground;
    const { from, along } = line;
    const radius = radiusOf(ground, level);
    const aside = from[2 - along] as number;
    const chord = Math.sqrt(
        Math.max(0, radius ** 2 - (aside - (middle[2 - along] as number)) ** 2),
    );
    const seen = seenLine(lens, line);
    const [low, high] = inPicture(lens, seen, [middle[along] - chord, middle[along] + chord]);
    const count = Math.max(1, Math.ceil(((high - low) / radius) * (PIECES / 2)));
    for (let i = 0; i < count && low < high; i++) {
        const [a, b] = [low + ((high - low) * i) / count, low + ((high - low) * (i + 1)) / count];
        const at: Vector = along === 0 ? [(a + b) / 2, 0, aside] : [aside, 0, (a + b) / 2];
        const strength = level.strength * strengthAt(lens, level.step, radius, middle, at);
        const pieces = looks.of(axis, strength);
        if (pieces) {
            addVisible(pieces, lens, pieceOf(lens, seen, [a, b]), sees);
        }
    }
}

/* Those of the level above are its own. */
function addLines(ground: Ground, level: Level, along: 0 | 2): void {
    const radius = radiusOf(ground, level);
    const middle = ground.middle[2 - along] as number;
    const last = Math.floor((middle + radius) / level.step);
    for (let i = Math.ceil((middle - radius) / level.step); i <= last; i++) {
        const aside = i * level.step;
        const from: Vector = along === 0 ? [0, 0, aside] : [aside, 0, 0];
        if (i % 10 !== 0) {
            addLine(ground, level, { from, along }, null);
        }
    }
}

/* `sees` null: nothing hides anything. */
export function gridStrokes(
    camera: Camera,
    size: Size,
    sees: Visible | null,
): readonly GridStroke[] {
    const { target } = camera;
    const ground: Ground = {
        ...{ lens: lensOf(camera, size), middle: [target[0], 0, target[2]] },
        ...{ sees, looks: newLooks() },
    };
    const levels = levelsOf(camera);
    for (const along of [0, 2] as const) {
        for (const level of levels) {
            addLines(ground, level, along);
        }
        const axis: Line = { from: [0, 0, 0], along };
        addLine(ground, levels.at(-1) as Level, axis, along);
    }
    return ground.looks.strokes();
}
