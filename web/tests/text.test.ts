/* SPDX-License-Identifier: MIT */
/* The scene as text: printed, read with faults at their places, and brought back by few edits. */
import { describe, expect, test } from "vitest";
import { preorder, type SceneDocument } from "../src/model/document.ts";
import { difference, meeting } from "../src/model/documentDiff.ts";
import { readDocument } from "../src/model/documentJson.ts";
import { faultAt, readText } from "../src/model/documentRead.ts";
import { documentText, partAt, partsOf, subjectAt } from "../src/model/documentText.ts";
import type { Json } from "../src/model/json.ts";
import { parseText, printText } from "../src/model/jsonText.ts";
import type { Operation } from "../src/model/operation.ts";
import { apply } from "../src/model/operations.ts";
import { judgeText } from "../src/model/textDraft.ts";
import { choose, random, randomOperation, SCENE, SCHEMA, scene } from "./fixture.ts";

const print = (document: SceneDocument): string => documentText(SCHEMA, document);

function applied(document: SceneDocument, ops: readonly Operation[]): SceneDocument {
    const result = apply(document, ops, SCHEMA);
    if (!result.ok) {
        throw new Error(`${result.problem.place}: ${result.problem.message}`);
    }
    return result.document;
}

function opsBetween(before: SceneDocument, after: SceneDocument): readonly Operation[] {
    const result = difference(SCHEMA, before, after);
    if (!result.ok) {
        throw new Error(`${result.problem.place}: ${result.problem.message}`);
    }
    return result.ops;
}

function parsed(text: string): SceneDocument {
    const result = parseText(text);
    if (!result.ok) {
        throw new Error(result.fault.message);
    }
    return readDocument(result.value.json);
}

/* A document after many random edits, those that fit. */
function grown(next: () => number, steps: number, mark: string): SceneDocument {
    let count = 0;
    const fresh = () => `${mark}${count++}`;
    let document = scene();
    for (let step = 0; step < steps; step++) {
        const result = apply(document, [randomOperation(document, next, fresh)], SCHEMA);
        document = result.ok ? result.document : document;
    }
    return document;
}

/* The same with ids of nodes exchanged at random, the root's excepted: all is elsewhere. */
function exchanged(document: SceneDocument, next: () => number): SceneDocument {
    const ids = [...document.nodes.keys()].filter((id) => id !== document.root);
    const others = [...ids].sort(() => next() - 0.5);
    const names = new Map(ids.map((id, i) => [id, others[i] as string]));
    const rename = (json: Json): Json => {
        if (Array.isArray(json)) {
            return json.map(rename);
        }
        if (typeof json !== "object" || json === null) {
            return json;
        }
        const entries = Object.entries(json).map(([name, value]) => [name, rename(value ?? null)]);
        const { id, type, radius, direction } = json as Record<string, Json>;
        const node = typeof id === "string" && type !== undefined && direction === radius;
        return {
            ...Object.fromEntries(entries),
            ...(node ? { id: names.get(String(id)) ?? String(id) } : {}),
        };
    };
    return parsed(JSON.stringify(rename(JSON.parse(print(document)) as Json)));
}

describe("few edits", () => {
    test("300 random pairs: the text of one is brought about from the other", () => {
        const kinds = new Set<string>();
        let exchanges = 0;
        for (let seed = 0; seed < 300; seed++) {
            const next = random(seed);
            const before = grown(next, 25, "a");
            const plain = grown(next, 25, choose(["a", "b"], next));
            const after = seed % 3 === 0 ? exchanged(plain, next) : plain;
            exchanges += after === plain ? 0 : 1;
            const wanted = print(after);
            const ops = opsBetween(before, parsed(wanted));
            for (const { op } of ops) {
                kinds.add(op);
            }
            expect(print(applied(before, ops)), `seed ${seed}`).toBe(wanted);
            expect(opsBetween(after, parsed(wanted))).toEqual([]);
        }
        expect(exchanges).toBe(100);
        expect([...kinds].sort()).toEqual(["insert", "move", "remove", "set"]);
    });

    test("one random edit comes back as no more operations than places it touched", () => {
        let checked = 0;
        let names = 0;
        for (let seed = 0; seed < 300; seed++) {
            const next = random(1000 + seed);
            const before = grown(next, 20, "a");
            const op = randomOperation(before, next, () => `z${names++}`);
            const result = apply(before, [op], SCHEMA);
            if (!result.ok) {
                continue;
            }
            const ops = opsBetween(before, result.document);
            const whole = op.op === "set" && /^\/camera$|\/transform$/.test(op.at);
            const most = whole ? 3 : result.inverse.length;
            expect(ops.length, JSON.stringify(op)).toBeLessThanOrEqual(most);
            checked++;
        }
        expect(checked).toBeGreaterThan(100);
    });

    test("a changed number is one set, and nothing else", () => {
        const text = print(scene()).replace('"radius": 0.6', '"radius": 0.75');
        expect(opsBetween(scene(), parsed(text))).toEqual([
            { op: "set", at: "/nodes/head/params/radius", value: 0.75 },
        ]);
    });

    test("a member that is taken away has its default; one of many moves alone", () => {
        const text = print(scene()).replace('"params": {"k": 0.2},', "");
        expect(opsBetween(scene(), parsed(text))).toEqual([
            { op: "set", at: "/nodes/neck/params/k", value: null },
        ]);
        const moved = applied(scene(), [
            { op: "move", at: "/nodes/stick", into: "/nodes/root", before: "neck" },
        ]);
        expect(opsBetween(scene(), moved)).toEqual([
            { op: "move", at: "/nodes/stick", into: "/nodes/root", before: "neck" },
        ]);
    });

    test("a parent and its child change places", () => {
        const swapped = JSON.parse(JSON.stringify(SCENE)) as { root: { children: Json[] } };
        swapped.root.children[0] = {
            id: "head",
            type: "sphere",
            children: [{ id: "neck", type: "smooth_union" }],
        };
        const after = readDocument(swapped as unknown as Json);
        expect(print(applied(scene(), opsBetween(scene(), after)))).toBe(print(after));
    });

    test("the root keeps its id", () => {
        const after = readDocument({ format: "fieldcast/1", root: { id: "top", type: "union" } });
        const result = difference(SCHEMA, scene(), after);
        expect(result).toMatchObject({ ok: false, problem: { place: "/nodes/root" } });
    });
});

describe("two authors", () => {
    const base = scene();
    const set = (at: string, value: Json): Operation => ({ op: "set", at, value });
    const meet = (mine: Operation, theirs: Operation) => meeting(base, [mine], [theirs]);

    test("meet where both write the same value, or one writes into what the other removes", () => {
        const at = "/nodes/body/params/radius";
        const radius = set(at, 2);
        expect(meet(radius, radius)).toEqual([at]);
        expect(meet(radius, { op: "remove", at: "/nodes/neck" })).toEqual([at]);
        expect(meet({ op: "remove", at: "/nodes/neck" }, radius)).toEqual(["/nodes/body"]);
    });

    test("do not meet where they write different values, or one moves what the other sets", () => {
        const radius = set("/nodes/body/params/radius", 2);
        expect(meet(radius, set("/nodes/body/name", "Body"))).toEqual([]);
        const move: Operation = {
            op: "move",
            at: "/nodes/body",
            into: "/nodes/root",
            before: null,
        };
        expect(meet(radius, move)).toEqual([]);
        expect(meet(move, move)).toHaveLength(1);
    });
});

describe("a text that was typed while others changed the scene", () => {
    const tell = () => "too much";
    const judge = (base: SceneDocument, now: SceneDocument, text: string) =>
        judgeText(SCHEMA, base, now, text, tell);

    test("300 random pairs: what does not meet adds up to the same, whoever comes first", () => {
        const kinds = { faults: 0, meeting: 0, edit: 0 };
        for (let seed = 0; seed < 300; seed++) {
            const next = random(5000 + seed);
            const base = scene();
            const changed = (mark: string) => {
                let names = 0;
                const fresh = () => `${mark}${names++}`;
                for (;;) {
                    const op = randomOperation(base, next, fresh);
                    const result = apply(base, [op], SCHEMA);
                    const plain = op.op === "set" || op.op === "remove";
                    if (plain && result.ok && opsBetween(base, result.document).length > 0) {
                        return result.document;
                    }
                }
            };
            const [mine, theirs] = [changed("m"), changed("t")];
            const judged = judge(base, theirs, print(mine));
            kinds[judged.kind]++;
            if (judged.kind === "edit") {
                const other = apply(mine, opsBetween(base, theirs), SCHEMA);
                expect(other.ok && print(other.document), `seed ${seed}`).toBe(
                    print(applied(theirs, judged.ops)),
                );
            } else if (judged.kind === "meeting" && judged.meeting.message !== "") {
                expect(print(applied(theirs, judged.meeting.ops))).toBe(print(mine));
            }
        }
        expect(kinds.edit).toBeGreaterThan(100);
        expect(kinds.meeting).toBeGreaterThan(5);
    });

    test("the same value meets; a node that is gone can be brought back", () => {
        const text = print(scene()).replace('"radius": 0.6', '"radius": 0.75');
        const at = "/nodes/head/params/radius";
        const other = applied(scene(), [{ op: "set", at, value: 2 }]);
        expect(judge(scene(), other, text)).toMatchObject({
            kind: "meeting",
            meeting: { places: [at], message: "", ops: [{ at, value: 0.75 }] },
        });
        const gone = applied(scene(), [{ op: "remove", at: "/nodes/neck" }]);
        const judged = judge(scene(), gone, text);
        const ops = judged.kind === "meeting" ? judged.meeting.ops : [];
        expect(print(applied(gone, ops))).toBe(text);
    });

    test("more than one edit may have is a fault", () => {
        const limits = [{ name: "operations", value: 1, unit: "", doc: "" }];
        const text = print(scene()).replace('"radius": 0.6', '"radius": 2').replace("45", "46");
        const judged = judgeText({ ...SCHEMA, limits }, scene(), scene(), text, tell);
        expect(judged).toMatchObject({ kind: "faults", faults: [{ message: "too much" }] });
    });
});

describe("the text", () => {
    test("reads back as the document, with nothing wrong in it", () => {
        const read = readText(SCHEMA, scene(), print(scene()));
        expect(read).toMatchObject({ ok: true });
        expect(read.ok && print(read.document)).toBe(print(scene()));
    });

    test("members stand in the order of the tables, short things on one line", () => {
        const text = print(
            readDocument({
                root: {
                    type: "sphere",
                    id: "r",
                    params: { radius: 2 },
                    transform: { scale: 2, translation: [1, 0, 0] },
                },
            }),
        );
        expect(text).toBe(
            [
                "{",
                '  "format": "fieldcast/1",',
                '  "root": {',
                '    "id": "r",',
                '    "type": "sphere",',
                '    "transform": {"translation": [1, 0, 0], "scale": 2},',
                '    "params": {"radius": 2}',
                "  }",
                "}",
                "",
            ].join("\n"),
        );
    });

    test("a line has 96 bytes at most, in UTF-8", () => {
        expect(printText([["a".repeat(90)]])).toBe(`[["${"a".repeat(90)}"]]\n`);
        expect(printText([["a".repeat(91)]])).toContain("\n");
        expect(printText([["ä".repeat(46)]])).toContain("\n  [");
    });

    test("the place of a path is where its value stands", () => {
        const text = print(scene());
        const read = parseText(text);
        const parts = read.ok ? partsOf(read.value) : [];
        const at = (place: string) => {
            const part = partAt(parts, place);
            return part && text.slice(part.from, part.to);
        };
        expect(at("/nodes/head/params/radius")).toBe("0.6");
        expect(at("/nodes/stick/params/primitive")).toBe('"rod"');
        expect(at("/camera/fov")).toBe("45");
        expect(at("/lights/lamp/intensity")).toBe("2");
        expect(at("/materials/coal/properties/glow")).toBe("1");
        expect(at("/nodes/foot")).toBe('{"id": "foot", "type": "sphere"}');
        expect(at("/nodes/foot/params/radius")).toBe(at("/nodes/foot"));
        expect(at("/nodes/gone")).toBeNull();
        const every = preorder(scene()).every((id) =>
            at(`/nodes/${id}`)?.includes(`"id": "${id}"`),
        );
        expect(every).toBe(true);
    });

    test("a character lies in a node, a resource or a record", () => {
        const text = print(scene());
        const read = parseText(text);
        const parts = read.ok ? partsOf(read.value) : [];
        const at = (word: string) => subjectAt(scene(), parts, text.indexOf(word));
        expect(at('"radius": 0.6')).toBe("/nodes/head");
        expect(at('"foot"')).toBe("/nodes/foot");
        expect(at('"coal"')).toBe("/materials/coal");
        expect(at('"lamp"')).toBe("/lights/lamp");
        expect(at('"fov"')).toBe("/camera");
        expect(at('"format"')).toBeNull();
    });
});

describe("faults", () => {
    function faults(change: (text: string) => string) {
        const text = change(print(scene()));
        const read = readText(SCHEMA, scene(), text);
        return read.ok
            ? []
            : read.faults.map(({ from, to, place, message }) => [
                  text.slice(from, to),
                  place,
                  message,
              ]);
    }
    const swap = (from: string, to: string) => faults((text) => text.replace(from, to));

    test.each([
        ['"fov": 45}', '"fov": 45,}', "}", "nothing follows the comma before }"],
        ['"fov": 45}', '"fov" 45}', "45", 'expected : behind "fov"'],
        ['"fov": 45}', '"fov": 4five}', "4five", "4five is no value of JSON"],
        ['"fov": 45}', '"fov": 045}', "045", "045 is no value of JSON"],
        ['"fov": 45}', '"fov": }', "}", 'the value of "fov" is missing'],
        ['"fov": 45}', '"fov": 45 "up": 1}', '"', "expected , or }"],
        ['"fov": 45}', '"fov": 45, "fov": 46}', '"fov"', '"fov" stands here twice'],
        [
            '"Snowman",',
            '"Snowman,',
            '"Snowman,',
            "this text does not end, or holds what no text may",
        ],
    ])("syntax: %s -> %s", (from, to, where, message) => {
        expect(swap(from, to)).toEqual([[where, "", message]]);
    });

    test("behind the document, and nothing at all", () => {
        expect(faults((text) => `${text}]`)).toEqual([
            ["]", "", "nothing may follow the document"],
        ]);
        expect(faults(() => "")).toEqual([["", "", "the document is missing"]]);
        expect(faults(() => "[".repeat(200))[0]?.[2]).toContain("160");
    });

    test.each([
        [
            '"radius": 0.6',
            '"radus": 0.6',
            '"radus"',
            "/nodes/head/params/radus",
            "sphere has no radus; it has radius",
        ],
        [
            '"radius": 0.6',
            '"radius": -1',
            "-1",
            "/nodes/head/params/radius",
            "-1 is below the minimum 0",
        ],
        [
            '"radius": 0.6',
            '"radius": null',
            "null",
            "/nodes/head/params/radius",
            "null is no value: leave the member out to have its default",
        ],
        ['"snow",', '"snaw",', '"snaw"', "/nodes/neck/material", "there is no material snaw"],
        ['"id": "head"', '"id": "body"', '"body"', "/nodes/body", "the id body is in use"],
        [
            '"type": "smooth_union"',
            '"type": "smoth_union"',
            '"smoth_union"',
            "/nodes/neck/type",
            "there is no node type smoth_union",
        ],
        [
            '"fieldcast/1"',
            '"fieldcast/2"',
            '"fieldcast/2"',
            "/format",
            'the format is "fieldcast/1"',
        ],
        ['"id": "root"', '"id": "top"', '"top"', "/nodes/root", "the root keeps its id root"],
        [
            '"shader": "flat"',
            '"shader": "flot"',
            '"flot"',
            "/materials/coal/shader",
            "there is no shader flot",
        ],
        [
            '"primitive": "rod"',
            '"primitive": "bar"',
            '"bar"',
            "/nodes/stick/params/primitive",
            "there is no primitive bar",
        ],
    ])("%s -> %s", (from, to, where, place, message) => {
        expect(swap(from, to)).toContainEqual([where, place, message]);
    });

    test("strange members and declared rows that are none", () => {
        expect(swap('"camera"', '"cam"')).toContainEqual([
            '"cam"',
            "/cam",
            expect.stringContaining("a scene has no cam; it has format, name, camera"),
        ]);
        const rows = swap('"range": [0, 10]', '"range": 7');
        expect(rows[0]?.[1]).toBe("/primitives/rod/params");
    });

    test("several at once, in the order of the text", () => {
        const found = faults((text) =>
            text.replace('"fov": 45', '"fov": 4500').replace('"radius": 0.6', '"radius": "big"'),
        );
        expect(found.map(([, place]) => place)).toEqual([
            "/camera/fov",
            "/nodes/head/params/radius",
        ]);
    });

    test("a node without an id gets the same one each time; roots keep theirs", () => {
        const text = print(scene())
            .replace('"id": "root",', "")
            .replace('"id": "pawn-root",', "")
            .replace('"id": "head",', "");
        const first = readText(SCHEMA, scene(), text);
        expect(first).toMatchObject({ ok: true, document: { root: "root" } });
        const document = first.ok ? first.document : scene();
        expect(document.nodes.has("sphere-1")).toBe(true);
        expect(document.models[0]?.root).toBe("pawn-root");
        const again = readText(SCHEMA, document, text);
        expect(again.ok && opsBetween(document, again.document)).toEqual([]);
    });

    test("what the server refuses is shown where it stands", () => {
        const read = readText(SCHEMA, scene(), print(scene()));
        const text = print(scene());
        const place = "/nodes/stick/params/radius";
        const fault = faultAt(read.parts ?? [], { code: "invalid", place, message: "no" });
        expect(text.slice(fault.from, fault.to)).toBe('"radius"');
    });
});
