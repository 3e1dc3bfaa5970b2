/* SPDX-License-Identifier: MIT */
/* A rough ball around nodes, for framing the view only: a node's own size is taken as the sum of
 * its length parameters, so it needs no knowledge of any node type. */
import type { Ball, Box } from "./camera.ts";
import { isVisible, modelNamed, type SceneDocument, type SceneNode } from "./document.ts";
import { type Reading, readingOf } from "./modelParams.ts";
import { nodeType, type Schema, valueIn } from "./schema.ts";
import {
    add,
    length,
    scale,
    subtract,
    toParent,
    toWorld,
    transformOf,
    type Vector,
    vectorOf,
} from "./transform.ts";
import { numbersOf } from "./values.ts";

/* A node without lengths and children still fills some of the view. */
const UNKNOWN_RADIUS = 1;

function merge(a: Ball | null, b: Ball | null): Ball | null {
    if (!a || !b) {
        return a ?? b;
    }
    const apart = subtract(b.center, a.center);
    const gap = length(apart);
    if (gap + b.radius <= a.radius) {
        return a;
    }
    if (gap + a.radius <= b.radius) {
        return b;
    }
    const radius = (gap + a.radius + b.radius) / 2;
    return { center: add(a.center, scale(apart, (radius - a.radius) / gap)), radius };
}

function ownRadius(node: SceneNode, schema: Schema): number {
    const row = nodeType(schema, node.type);
    let sum = 0;
    for (const param of row?.params ?? []) {
        if (param.unit === "length") {
            sum += length(vectorOf(numbersOf(valueIn(node.params, param), 1)));
        }
    }
    return sum;
}

const asItIs: Reading = (node) => node;

/* In the space of the node's parent; null: nothing is to be seen. An instance has its own numbers in
 * its model. */
export function ballIn(
    document: SceneDocument,
    node: SceneNode,
    schema: Schema,
    reading: Reading = asItIs,
): Ball | null {
    if (!isVisible(node)) {
        return null;
    }
    let ball: Ball | null = null;
    const model = modelNamed(schema, document, node);
    const inside = model ? readingOf(schema, document, model, node) : reading;
    for (const id of model ? [model.root] : node.children) {
        const child = document.nodes.get(id);
        ball = merge(ball, child ? ballIn(document, inside(child), schema, inside) : null);
    }
    const own = ownRadius(node, schema);
    const isShape = nodeType(schema, node.type)?.children === "none" && model === null;
    if (isShape) {
        ball = merge(ball, { center: [0, 0, 0], radius: own || UNKNOWN_RADIUS });
    } else if (ball) {
        ball = { center: ball.center, radius: ball.radius + own };
    }
    if (!ball) {
        return null;
    }
    const transform = transformOf(node);
    const largest = Math.max(...transform.scale.map(Math.abs));
    return { center: toParent(transform, ball.center), radius: ball.radius * largest };
}

/* The least cube around a ball, and the ball of half the longest side in the middle of a box. */
export const boxAround = ({ center, radius }: Ball): Box => ({
    low: subtract(center, [radius, radius, radius]),
    high: add(center, [radius, radius, radius]),
});
export const ballWithin = ({ low, high }: Box): Ball => ({
    center: scale(add(low, high), 0.5),
    radius: Math.max(...subtract(high, low)) / 2,
});

/* Around the given nodes, in the world; around everything where none is given. Where nothing is to be
 * seen, it is around the place of the first. */
export function ballOf(
    document: SceneDocument,
    schema: Schema,
    ids: readonly string[] = [document.root],
): Ball {
    let all: Ball | null = null;
    for (const id of ids) {
        const node = document.nodes.get(id);
        let ball = node ? ballIn(document, node, schema) : null;
        for (let parent = node?.parent; ball && parent != null; ) {
            const above: SceneNode | undefined = document.nodes.get(parent);
            if (!above) {
                break;
            }
            const transform = transformOf(above);
            const center: Vector = toParent(transform, ball.center);
            ball = { center, radius: ball.radius * Math.max(...transform.scale.map(Math.abs)) };
            parent = above.parent;
        }
        all = merge(all, ball);
    }
    const [first = document.root] = ids;
    const place = document.nodes.has(first) ? toWorld(document, first, [0, 0, 0]) : null;
    return all ?? { center: place ?? [0, 0, 0], radius: UNKNOWN_RADIUS };
}
