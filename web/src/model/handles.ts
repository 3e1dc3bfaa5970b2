/* SPDX-License-Identifier: MIT */
/* Handles of parameters: points of a node, light or volume at which a value is seen and dragged. Where
 * they are is a fact of the registry (`handle` of its rows). */
import { ballIn } from "./bounds.ts";
import { cornerHandles, cornerLabel, dragCorner, isCorner } from "./corners.ts";
import {
    findResource,
    nodeParams,
    pathTo,
    resourceParams,
    type SceneDocument,
    type SceneNode,
} from "./document.ts";
import {
    evaluatePoint,
    NO_SKIN,
    type Numbers,
    namesOf,
    namesSkin,
    namesWith,
    numberName,
    pointsIn,
    type Skin,
} from "./handleTexts.ts";
import { type Reading, settingOf } from "./modelParams.ts";
import type { Operation } from "./operation.ts";
import { valuesPlace } from "./places.ts";
import { alongLine, onPlane, type Projection, type Ray, type Spot } from "./projection.ts";
import {
    components,
    findParam,
    matters,
    nodeType,
    type Param,
    type Schema,
    valueIn,
} from "./schema.ts";
import { skinOf } from "./skin.ts";
import {
    add,
    cross,
    fromParent,
    into,
    length,
    outOf,
    scale,
    subtract,
    transformOf,
    type Vector,
    vectorOf,
} from "./transform.ts";
import { isAngle, printInUnit, snap, tidy, tidyAngle } from "./units.ts";
import { clampNumber, numbersOf } from "./values.ts";
import type { Subject } from "./view.ts";

/* What has handles: its rows and values, and its space. */
export interface Owner extends Numbers {
    readonly toWorld: (point: Vector) => Vector;
    readonly fromWorld: (point: Vector) => Vector;
    /* It joins others: its lengths are of no shape. */
    readonly joins: boolean;
}

/* What a handle is drawn as, beside the point where it is. */
export type HandleLook =
    /* A place, or a radius on its surface. */
    | { readonly kind: "place" | "dot" }
    /* A length: from its tail to the point is the way that it grows. */
    | { readonly kind: "arrow"; readonly tail: Spot }
    /* An angle: the way of the point from where there is none. */
    | { readonly kind: "arc"; readonly spots: readonly Spot[] }
    /* A corner of a flat shape, with the one after it. */
    | { readonly kind: "corner"; readonly next: Spot | null }
    /* The reach of a blend: pixels around the middle of what it joins. */
    | { readonly kind: "band"; readonly middle: Spot; readonly radius: number };

/* What a handle drags. */
export interface Dragged {
    readonly owner: Owner;
    readonly param: Param;
    /* What it is called: the row's name, or that of an instance's parameter that sets it. */
    readonly name: string;
    /* Where the value goes, and the row whose range it keeps to. */
    readonly at: string;
    readonly limits: Param;
    /* Which number of the value that is; null: all. */
    readonly part: number | null;
}

export interface Handle extends Dragged {
    /* "radius", "size.x", "points.0". */
    readonly key: string;
    /* Which number or point of the value it changes; null: all, as a place. */
    readonly component: number | null;
    /* The texts of its three coordinates. */
    readonly texts: readonly string[];
    readonly spot: Spot;
    readonly look: HandleLook;
}

const ORIGIN: Vector = [0, 0, 0];

/* In the world; null where the expressions have no value. */
function pointOf(owner: Owner, texts: readonly string[], key = "", value = 0): Vector | null {
    const point = evaluatePoint(texts, namesWith(namesOf(owner), key, value));
    return point.every(Number.isFinite) ? owner.toWorld(point) : null;
}

/* --- looks --- */

/* Pixels from the tail of an arrow to the point; where it points at the viewer, there is none. It is
 * on the inner side, where it takes no place from the tips of the gizmo. */
const ARROW = 20;
const HEAD_ON = 0.25;
const ARC_STEPS = 16;
const TURN = 2 * Math.PI;
/* Names of lengths that are measured from a middle: their points are dots on the surface. What grows
 * out of a skin has none. */
const RADIUS = /^(radi|tube|round)/;

interface Curve {
    readonly value: number;
    readonly projection: Projection;
    /* In the world, by the value. */
    readonly at: (value: number) => Vector | null;
}

function arrowOf({ value, projection, at }: Curve): HandleLook {
    const [here, there] = [at(value), at(value + NUDGE)];
    const way = here && there ? subtract(there, here) : ORIGIN;
    const speed = length(way);
    if (!here || speed === 0) {
        return { kind: "dot" };
    }
    const pixels = ARROW * projection.unitsAt(here);
    const [spot, tail] = [here, add(here, scale(way, -pixels / speed))].map(projection.spotOf);
    const seen = spot && tail ? Math.hypot(tail.x - spot.x, tail.y - spot.y) : 0;
    return tail && seen > HEAD_ON * ARROW ? { kind: "arrow", tail } : { kind: "dot" };
}

/* At most one turn of it. */
function arcOf({ value, projection, at }: Curve, unit: Param["unit"]): HandleLook {
    const whole = unit === "degrees" ? 360 : TURN;
    const end = Math.sign(value) * Math.min(Math.abs(value), whole);
    const spots = Array.from({ length: ARC_STEPS + 1 }, (_, i) => {
        const point = at(value - (end * i) / ARC_STEPS);
        return point && projection.spotOf(point);
    });
    return { kind: "arc", spots: spots.filter((spot) => spot !== null) };
}

function bandOf({ value, projection, at }: Curve): HandleLook {
    const [middle, end] = [at(0), at(value)];
    const spot = middle && projection.spotOf(middle);
    return spot && end
        ? {
              kind: "band",
              middle: spot,
              radius: length(subtract(end, middle)) / projection.unitsAt(middle),
          }
        : { kind: "dot" };
}

function lookOf(owner: Owner, param: Param, component: number | null, curve: Curve): HandleLook {
    if (component === null) {
        return { kind: "place" };
    }
    if (isAngle(param.unit)) {
        return arcOf(curve, param.unit);
    }
    if (param.unit !== "length" || (RADIUS.test(param.name) && !namesSkin(param))) {
        return { kind: "dot" };
    }
    return owner.joins ? bandOf(curve) : arrowOf(curve);
}

function handlesOfParam(dragged: Dragged, projection: Projection): Handle[] {
    const { owner, param, name, part } = dragged;
    if (param.type === "points") {
        return cornerHandles(dragged, projection);
    }
    const points = pointsIn(param);
    const count = components(param.type);
    return points.flatMap((texts, i) => {
        const component = points.length === 1 && count > 1 ? part : i;
        if (part !== null && component !== part) {
            return [];
        }
        const key = part === null ? numberName(name, count, component) : name;
        const number = numberName(param.name, count, component);
        const point = pointOf(owner, texts);
        const spot = point && projection.spotOf(point);
        const at = (value: number): Vector | null => pointOf(owner, texts, number, value);
        const look = lookOf(owner, param, component, {
            value: namesOf(owner)(number),
            projection,
            at,
        });
        return spot ? [{ ...dragged, key, component, texts, spot, look }] : [];
    });
}

/* Of the last node of a path. */
function ownerAt(
    document: SceneDocument,
    schema: Schema,
    path: readonly SceneNode[],
    reading?: Reading,
): Owner | null {
    const node = path.at(-1);
    if (!node) {
        return null;
    }
    /* What an operation does has no place of its own: it is shown in the middle of its operands. */
    const isOperation = nodeType(schema, node.type)?.group === "operation";
    const ball = isOperation ? ballIn(document, node, schema, reading) : null;
    const middle = ball ? fromParent(transformOf(node), ball.center) : ORIGIN;
    let skin: Skin | null = null;
    return {
        params: nodeParams(schema, document, node),
        values: node.params,
        skin: () => {
            skin ??= skinOf(document, schema, node, reading);
            return skin;
        },
        toWorld: (point) => outOf(path, add(point, middle)),
        fromWorld: (point) => subtract(into(path, point), middle),
        joins: isOperation,
    };
}

const itself = (owner: Owner, param: Param, place: string): Dragged => ({
    ...{ owner, param, name: param.name, at: `${place}/${param.name}`, limits: param },
    part: null,
});

/* Where a node is, among what is around it: no row of the schema says so, as nodes have the gizmo. */
const PLACE = "translation";
const PLACE_HANDLE = ["x", "y", "z"].map((axis) => `${PLACE}.${axis}`).join();

function placeOwner(schema: Schema, path: readonly SceneNode[]): Owner | null {
    const node = path.at(-1);
    if (!node) {
        return null;
    }
    const around = [...path.slice(0, -1), { ...node, transform: {} }];
    return {
        params: schema.transform.map((row) =>
            row.name === PLACE ? { ...row, handle: PLACE_HANDLE } : row,
        ),
        values: node.transform,
        skin: NO_SKIN,
        toWorld: (point) => outOf(around, point),
        fromWorld: (point) => into(around, point),
        joins: false,
    };
}

/* What a parameter of an instance changes of a node within. */
function within(
    document: SceneDocument,
    schema: Schema,
    path: readonly SceneNode[],
    own: Dragged,
): Dragged | null {
    const setting = settingOf(schema, document, path, own.name);
    if (setting === null) {
        return null;
    }
    const { target, reading } = setting;
    const owner =
        target.group === "params"
            ? ownerAt(document, schema, setting.path, reading)
            : placeOwner(schema, setting.path);
    const param = owner && findParam(owner.params, target.name);
    return param ? { ...own, owner, param, part: target.component } : null;
}

function nodeValues(document: SceneDocument, schema: Schema, id: string): readonly Dragged[] {
    const path = pathTo(document, id);
    const owner = path[0]?.id === document.root ? ownerAt(document, schema, path) : null;
    return (owner?.params ?? []).flatMap((param) => {
        const own = owner && itself(owner, param, `/nodes/${id}/params`);
        return (own && (within(document, schema, path, own) ?? own)) || [];
    });
}

function resourceValues(
    document: SceneDocument,
    schema: Schema,
    { list, name }: Extract<Subject, { kind: "resource" }>,
): readonly Dragged[] {
    const resource = findResource(document, list, name);
    const params = resource ? resourceParams(schema, document, list, resource.type) : [];
    const row = params.find((param) => param.name === "position");
    if (!resource || !row) {
        return [];
    }
    const position = vectorOf(numbersOf(valueIn(resource.values, row)));
    const owner: Owner = {
        params,
        values: resource.values,
        skin: NO_SKIN,
        toWorld: (point) => add(point, position),
        fromWorld: (point) => subtract(point, position),
        joins: false,
    };
    return params.map((param) => itself(owner, param, valuesPlace(list, name)));
}

/* Of the one node that is selected, or of the light or volume that the inspector shows. */
export function handlesOf(
    document: SceneDocument,
    schema: Schema,
    selection: readonly string[],
    subject: Subject,
    projection: Projection,
): readonly Handle[] {
    const all =
        subject.kind === "resource"
            ? resourceValues(document, schema, subject)
            : selection.length === 1 && subject.kind === "nodes"
              ? nodeValues(document, schema, selection[0] ?? "")
              : [];
    return all
        .filter(({ param }) => param.handle !== "" || param.type === "points")
        .filter(({ owner, param }) => matters(owner.params, owner.values, param))
        .flatMap((dragged) => handlesOfParam(dragged, projection));
}

/* "radius 0.75", "b 0 0.5 0". */
function labelOf({ key, param, component }: Handle, value: readonly number[]): string {
    const shown = component === null ? value : [value[component] ?? 0];
    return [key, ...shown.map((x) => printInUnit(x, param.unit))].join(" ");
}

/* What a handle is and the value that it has. */
export function handleLabel(handle: Handle): string {
    const { owner, param } = handle;
    if (isCorner(handle)) {
        return cornerLabel(handle);
    }
    return labelOf(handle, numbersOf(valueIn(owner.values, param), components(param.type)));
}

/* The nearest within `slop` pixels. */
export function handleAt(handles: readonly Handle[], { x, y }: Spot, slop: number): Handle | null {
    const far = ({ spot }: Handle): number => Math.hypot(spot.x - x, spot.y - y);
    const near = handles.filter((handle) => far(handle) <= slop);
    return near.reduce<Handle | null>((a, b) => (a && far(a) <= far(b) ? a : b), null);
}

/* --- dragging --- */

const STEPS = 24;
const HALVINGS = 24;
/* Rounding: a way that is longer by this part is no longer. */
const LONGER = 1 + 1e-9;
const NUDGE = 1e-4;
const SNAP_LENGTH = 0.1;
const SNAP_ANGLE = Math.PI / 12;

/* How far a ray passes from a point. */
function missOf({ from, along }: Ray, point: Vector | null): number {
    return point ? length(cross(subtract(point, from), along)) : Number.NaN;
}

/* The value whose point is nearest to a ray: Newton's steps along the tangent of its curve, halved
 * while they lead away from the ray, as behind the end of a curve (1/x). */
function valueNear(handle: Handle, projection: Projection, spot: Spot): number | null {
    const { owner, texts, param, component, limits } = handle;
    const number = numberName(param.name, components(param.type), component);
    const ray = projection.rayAt(spot);
    const missAt = (at: number): number => missOf(ray, pointOf(owner, texts, number, at));
    let value = namesOf(owner)(number);
    for (let i = 0; i < STEPS; i++) {
        const here = pointOf(owner, texts, number, value);
        const there = pointOf(owner, texts, number, value + NUDGE);
        if (!here || !there) {
            return null;
        }
        const way = subtract(there, here);
        const speed = length(way) / NUDGE;
        const far = speed > 0 ? alongLine(ray, here, scale(way, 1 / length(way))) : null;
        if (far === null) {
            return null;
        }
        let step = far / speed;
        const most = LONGER * missOf(ray, here);
        for (let k = 0; k < HALVINGS && !(missAt(clampNumber(limits, value + step)) <= most); k++) {
            step /= 2;
        }
        value = clampNumber(limits, value + step);
    }
    return value;
}

/* The place under the pointer at the depth where the handle was. */
function placeNear({ owner, texts }: Handle, projection: Projection, spot: Spot): Vector | null {
    const start = pointOf(owner, texts);
    const there = start && onPlane(projection.rayAt(spot), start, projection.forward);
    return there && owner.fromWorld(there);
}

export interface HandleChange {
    readonly op: Operation;
    /* "radius 0.75". */
    readonly label: string;
}

/* What a drag from one point of the picture to another makes of the value; null: nothing. */
export function dragHandle(
    handle: Handle,
    projection: Projection,
    from: Spot,
    to: Spot,
    snaps: boolean,
): HandleChange | null {
    const { param, owner, component, limits, part } = handle;
    const spot = { x: handle.spot.x + to.x - from.x, y: handle.spot.y + to.y - from.y };
    if (isCorner(handle)) {
        return dragCorner(handle, projection, spot, snaps);
    }
    const angle = isAngle(param.unit);
    const rounded = (x: number): number => {
        const stepped = snaps ? snap(x, angle ? SNAP_ANGLE : SNAP_LENGTH) : x;
        const clamped = clampNumber(limits, stepped);
        return angle ? tidyAngle(clamped) : tidy(clamped);
    };
    const place = component === null ? placeNear(handle, projection, spot) : null;
    const number = component === null ? null : valueNear(handle, projection, spot);
    if (place === null && number === null) {
        return null;
    }
    const count = components(param.type);
    const own = numbersOf(valueIn(owner.values, param), count);
    const next = own.map((x, i) => {
        const wanted = place ? place[i] : i === component ? number : x;
        return wanted == null ? x : i === component || place ? rounded(wanted) : x;
    });
    const value = count === 1 || part !== null ? (next[part ?? 0] ?? 0) : next;
    return {
        op: { op: "set", at: handle.at, value },
        label: labelOf(handle, next),
    };
}
