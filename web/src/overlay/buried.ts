/* SPDX-License-Identifier: MIT */
/* The box of a selection of which the picture shows nothing, such as a shape within another one. */
import type { Box, Camera } from "../model/camera.ts";
import { projectionOf, type Size, type Spot } from "../model/projection.ts";
import { limitOf } from "../model/schema.ts";
import type { Stores } from "../model/stores.ts";
import type { Vector } from "../model/transform.ts";

export type AskBox = (nodes: readonly string[]) => Promise<Box | null>;

/* Corners by bits: x, y and z are at the high side. An edge joins two that differ in one. */
const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7] as const;
const EDGES = CORNERS.flatMap((a) =>
    [1, 2, 4].filter((bit) => !(a & bit)).map((bit) => [a, a | bit]),
);

/* The edges that are in front of the camera. */
export function boxLines(
    { low, high }: Box,
    camera: Camera,
    size: Size,
): readonly (readonly [Spot, Spot])[] {
    const { spotOf } = projectionOf(camera, size);
    const spots = CORNERS.map((corner) => {
        const side = (axis: 0 | 1 | 2): number => ((corner >> axis) & 1 ? high : low)[axis];
        const point: Vector = [side(0), side(1), side(2)];
        return spotOf(point);
    });
    return EDGES.flatMap(([a = 0, b = 0]) => {
        const [from, to] = [spots[a], spots[b]];
        return from && to ? [[from, to] as const] : [];
    });
}

/* Asks the server for the box of nodes, once for each of their states. */
export class Boxes {
    readonly #stores: Stores;
    readonly #ask: AskBox;
    readonly #heard: () => void;
    #asked = "";
    #box: Box | null = null;

    /* `heard` runs when an answer is there. */
    constructor(stores: Stores, ask: AskBox, heard: () => void) {
        this.#stores = stores;
        this.#ask = ask;
        this.#heard = heard;
    }

    /* Null: it has no end, or the answer is still to come. */
    boxOf(nodes: readonly string[], revision: number): Box | null {
        const { scene, schema } = this.#stores.document.getState();
        const asked = [scene, revision, ...nodes].join(" ");
        if (asked !== this.#asked && nodes.length <= limitOf(schema, "isolated", 256)) {
            this.#asked = asked;
            this.#box = null;
            void this.#hear(asked, nodes);
        }
        return asked === this.#asked ? this.#box : null;
    }

    async #hear(asked: string, nodes: readonly string[]): Promise<void> {
        const box = await this.#ask(nodes).catch(() => null);
        if (asked === this.#asked) {
            this.#box = box;
            this.#heard();
        }
    }
}
