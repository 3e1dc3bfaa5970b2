// SPDX-License-Identifier: MIT
// What the examples show is as it should be in nature.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import test from "node:test";

const read = (name) =>
  JSON.parse(readFileSync(new URL(`../../protocol/examples/${name}.json`, import.meta.url), "utf8"));

const placeOf = (node) => node.transform?.translation ?? [0, 0, 0];

/** Where copies along X stand: `count` of them around the middle. */
const copies = ({ spacing, count }) =>
  Array.from({ length: count[0] }, (_, i) => (i - (count[0] - 1) / 2) * spacing[0]);

/** How high the ellipsoid is at x, z. */
const topAt = (ground, x, z) => {
  const [a, b, c] = ground.params.radii;
  return placeOf(ground)[1] + b * Math.sqrt(Math.max(1 - (x / a) ** 2 - (z / c) ** 2, 0));
};

// Else a thin bright arc of what is behind shows between hill and trees. Hill and trees are bent
// together, so they are compared before.
test("trees of the foggy valley stand in their hills", () => {
  const valley = read("foggy-valley");
  const low = valley.models.pine.children[0];
  const foot = placeOf(low)[1] - low.params.height / 2;
  const ridges = valley.root.children.filter((node) => node.id.startsWith("ridge-"));
  let trees = 0;

  for (const { id, children } of ridges) {
    const [ground, ...rows] = children;
    for (const row of rows) {
      const [dx, dy, dz] = placeOf(row);
      const base = dy + foot * row.children[0].transform.scale;
      for (const x of copies(row.params)) {
        const room = topAt(ground, x + dx, dz) - base;
        assert.ok(room >= 0, `${row.id}: the tree at ${x} is ${-room} above ${id}`);
        trees++;
      }
    }
  }
  assert.ok(trees > 100, `${trees} trees`);
});

test("each of at least 24 surfaces by an equation names its source", () => {
  const files = readdirSync(new URL("../../protocol/examples/", import.meta.url));
  const surfaces = files.flatMap((file) => /^(surface-.*)\.json$/.exec(file)?.[1] ?? []).sort();
  const readme = readFileSync(new URL("../../protocol/README.md", import.meta.url), "utf8");
  const rows = [...readme.matchAll(/^\| `(surface-[^`]*)` \| .*[A-Z]\S* ?[A-Z].* \|$/gm)];

  assert.ok(surfaces.length >= 24);
  assert.deepEqual(rows.map((row) => row[1]), surfaces);
  for (const surface of surfaces) {
    const types = JSON.stringify(read(surface)).match(/"type":"(implicit|parametric)"/g);
    assert.ok(types, `${surface} has no equation`);
  }
});
