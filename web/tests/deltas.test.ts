// SPDX-License-Identifier: MIT
// What differs from an earlier picture: its squares, and that it goes with no other one. That the
// pixels are right is seen in a browser (tests/e2e/deltas.test.mjs).
import { expect, test } from "vitest";
import { Chains, readDelta } from "../src/link/deltas.ts";
import { HEADER } from "./fixture.ts";

const payload = (...bytes: number[]): Blob =>
    new Blob([new Uint8Array(bytes)], { type: "image/png" });

test("runs of squares stand before the picture of them", async () => {
    const { squares, atlas } = await readDelta(payload(2, 0, 5, 0, 3, 0, 1, 1, 1, 0, 77, 78));
    expect(squares).toEqual([5, 6, 7, 257]);
    expect([...new Uint8Array(await atlas.arrayBuffer())]).toEqual([77, 78]);
    expect(atlas.type).toBe("image/png");
    expect((await readDelta(payload(0, 0))).squares).toEqual([]);
});

test("what differs goes with the picture before it alone", async () => {
    const chains = new Chains();
    const delta = { ...HEADER, delta: true, chain: 3, link: 1 };
    const none = Promise.resolve(payload(0, 0));
    const refused = async (): Promise<void> => {
        await expect(chains.compose(delta, none)).rejects.toThrow("no picture before");
    };
    await refused();
    chains.keep({ ...HEADER, chain: 2, link: 0 }, none);
    await refused();
    chains.keep({ ...HEADER, chain: 3, link: 1 }, none);
    await refused();
    chains.keep({ ...HEADER, chain: 3, link: 0 }, none);
    chains.clear();
    await refused();
});
