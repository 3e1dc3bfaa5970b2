/* SPDX-License-Identifier: MIT */
import { expect, test } from "vitest";
import type { SceneDocument } from "../src/model/document.ts";
import { printDocument, readDocument } from "../src/model/documentJson.ts";
import { equalJson } from "../src/model/json.ts";
import type { Operation } from "../src/model/operation.ts";
import { type Applied, apply, join } from "../src/model/operations.ts";
import { LIST_NAMES } from "../src/model/places.ts";
import { random, randomOperation, SCENE, SCHEMA, scene } from "./fixture.ts";

function applied(document: SceneDocument, ops: readonly Operation[]) {
    const result = apply(document, ops, SCHEMA);
    if (!result.ok) {
        throw new Error(result.problem.message);
    }
    return result;
}

const problem = (result: Applied) => (result.ok ? null : result.problem);

/* Order of resources is part of a document, which equality of JSON objects does not see. */
function same(a: SceneDocument, b: SceneDocument): boolean {
    const names = (d: SceneDocument) =>
        LIST_NAMES.map((list) => d[list].map(({ name }) => name).join()).join("; ");
    return equalJson(printDocument(a), printDocument(b)) && names(a) === names(b);
}

test("a document prints as it was read", () => {
    expect(equalJson(printDocument(scene()), SCENE)).toBe(true);
});

test("apply then inverse gives back every random document", () => {
    let accepted = 0;
    const kinds = new Set<string>();
    for (let seed = 0; seed < 60; seed++) {
        const next = random(seed);
        let count = 0;
        const fresh = () => `n${count++}`;
        let document = scene();
        for (let step = 0; step < 40; step++) {
            const ops = Array.from({ length: 1 + Math.floor(next() * 3) }, () =>
                randomOperation(document, next, fresh),
            );
            const frozen = JSON.stringify(printDocument(document));
            const result = apply(document, ops, SCHEMA);
            expect(JSON.stringify(printDocument(document))).toBe(frozen);
            if (!result.ok) {
                continue;
            }
            accepted++;
            for (const { op } of ops) {
                kinds.add(op);
            }
            const back = applied(result.document, result.inverse);
            expect(same(back.document, document)).toBe(true);
            const again = applied(back.document, back.inverse);
            expect(same(again.document, result.document)).toBe(true);
            document = result.document;
        }
    }
    expect(accepted).toBeGreaterThan(500);
    expect([...kinds].sort()).toEqual(["insert", "move", "remove", "set"]);
});

test("all operations apply or none", () => {
    const document = scene();
    const result = apply(
        document,
        [
            { op: "set", at: "/nodes/body/params/radius", value: 2 },
            { op: "remove", at: "/nodes/nobody" },
        ],
        SCHEMA,
    );
    expect(problem(result)).toMatchObject({ code: "not_found", place: "/nodes/nobody" });
    expect(document.nodes.get("body")?.params.radius).toBe(1);
});

test("what an edit does not touch is shared", () => {
    const before = scene();
    const { document } = applied(before, [{ op: "set", at: "/nodes/body/name", value: "b" }]);
    expect(document.nodes.get("head")).toBe(before.nodes.get("head"));
    expect(document.materials).toBe(before.materials);
    expect(document.camera).toBe(before.camera);
});

test("a new type keeps what it knows and accepts, and comes back whole", () => {
    const before = scene();
    const toTorus = applied(before, [{ op: "set", at: "/nodes/body/type", value: "torus" }]);
    expect(toTorus.document.nodes.get("body")).toMatchObject({
        type: "torus",
        params: { radius: 1 },
    });
    const toBox = applied(before, [{ op: "set", at: "/nodes/body/type", value: "box" }]);
    expect(toBox.document.nodes.get("body")?.params).toEqual({});
    expect(same(applied(toBox.document, toBox.inverse).document, before)).toBe(true);
});

const REFUSED: readonly (readonly [string, Operation, string])[] = [
    ["root removed", { op: "remove", at: "/nodes/root" }, "conflict"],
    [
        "root moved",
        { op: "move", at: "/nodes/root", into: "/nodes/neck", before: null },
        "conflict",
    ],
    [
        "moved into its own subtree",
        { op: "move", at: "/nodes/neck", into: "/nodes/body", before: null },
        "conflict",
    ],
    [
        "moved before itself",
        { op: "move", at: "/nodes/body", into: "/nodes/neck", before: "body" },
        "conflict",
    ],
    [
        "id in use",
        { op: "insert", into: "/nodes/root", before: null, value: { id: "hat", type: "box" } },
        "conflict",
    ],
    [
        "before a stranger",
        { op: "insert", into: "/nodes/neck", before: "hat", value: { id: "x", type: "box" } },
        "not_found",
    ],
    ["material in use", { op: "remove", at: "/materials/snow" }, "conflict"],
    ["unknown material", { op: "set", at: "/nodes/hat/material", value: "tin" }, "not_found"],
    ["unknown parameter", { op: "set", at: "/nodes/body/params/k", value: 1 }, "not_found"],
    ["unknown type", { op: "set", at: "/nodes/body/type", value: "blob" }, "invalid"],
    ["no such place", { op: "set", at: "/nodes", value: 1 }, "not_found"],
    [
        "light into materials",
        { op: "move", at: "/lights/sun", into: "/materials", before: null },
        "not_found",
    ],
];

test.each(REFUSED)("refused: %s", (_, operation, code) => {
    expect(problem(apply(scene(), [operation], SCHEMA))?.code).toBe(code);
});

test("move orders siblings and keeps the subtree", () => {
    const { document } = applied(scene(), [
        { op: "move", at: "/nodes/head", into: "/nodes/neck", before: "body" },
        { op: "move", at: "/nodes/neck", into: "/nodes/root", before: null },
    ]);
    expect(document.nodes.get("neck")?.children).toEqual(["head", "body"]);
    expect(document.nodes.get("root")?.children).toEqual(["hat", "stick", "neck"]);
});

test("joined edits do what both did, with one set per place", () => {
    const set = (value: number): Operation => ({
        op: "set",
        at: "/nodes/body/params/radius",
        value,
    });
    const hide: Operation = { op: "set", at: "/nodes/hat/visible", value: false };
    expect(join(SCHEMA, [set(1), hide], [set(2)])).toEqual([set(2), hide]);
    const type: Operation = { op: "set", at: "/nodes/body/type", value: "box" };
    expect(join(SCHEMA, [set(1), type], [set(2)])).toHaveLength(3);
    for (let seed = 0; seed < 200; seed++) {
        const next = random(seed);
        const fresh = () => `n${seed}`;
        const first = randomOperation(scene(), next, fresh);
        const second = randomOperation(scene(), next, () => `m${seed}`);
        const one = apply(scene(), [first], SCHEMA);
        const two = one.ok ? apply(one.document, [second], SCHEMA) : one;
        if (two.ok) {
            const both = applied(scene(), join(SCHEMA, [first], [second]));
            expect(same(both.document, two.document)).toBe(true);
        }
    }
});

test("nodes without an id get the first free one", () => {
    const document = readDocument({
        root: { type: "union", children: [{ type: "sphere" }, { type: "sphere" }] },
    });
    expect([...document.nodes.keys()]).toEqual(["union-1", "sphere-1", "sphere-2"]);
});
