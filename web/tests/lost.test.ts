/* SPDX-License-Identifier: MIT */
/* What somebody else takes away is told to whoever looks at it. */
import { expect, test } from "vitest";
import { Notices } from "../src/link/notices.ts";
import { findResource, type Resource, type SceneDocument } from "../src/model/document.ts";
import type { Operation } from "../src/model/operation.ts";
import { apply } from "../src/model/operations.ts";
import { renameResource } from "../src/model/resources.ts";
import { createStores } from "../src/model/stores.ts";
import type { View } from "../src/model/view.ts";
import { SCHEMA, scene } from "./fixture.ts";

function after(view: Partial<View>, ops: (before: SceneDocument) => readonly Operation[]) {
    const stores = createStores(null);
    const before = scene();
    const result = apply(before, ops(before), SCHEMA);
    if (!result.ok) {
        throw new Error(result.problem.message);
    }
    stores.view.setState(view);
    new Notices(stores).lost(before, result.document);
    const { selection, subject, code } = stores.view.getState();
    const told = stores.notices.getState().notices.map(({ message }) => message);
    return { told, selection, subject, code };
}

const remove = (at: string) => () => [{ op: "remove", at } as const];
const material = (name: string) => ({ kind: "resource", list: "materials", name }) as const;

test("a selected node that somebody else deletes is told by its name", () => {
    expect(after({ selection: ["stick"] }, remove("/nodes/stick")).told).toEqual([
        "Stick deleted by somebody else.",
    ]);
    const both = { selection: ["head", "body"] };
    expect(after(both, remove("/nodes/neck")).told).toEqual(["2 nodes deleted by somebody else."]);
});

test("what nobody looks at goes without a word", () => {
    expect(after({ selection: ["body"] }, remove("/nodes/stick")).told).toEqual([]);
    const looked = { selection: ["stick"], subject: { kind: "camera" } } as const;
    expect(after(looked, remove("/nodes/stick")).told).toEqual([]);
});

test("a material that somebody else renames is followed", () => {
    const rename = (before: SceneDocument) => {
        const found = findResource(before, "materials", "snow") as Resource;
        return renameResource(before, SCHEMA, "materials", found, "ice").ops;
    };
    const { told, subject } = after({ subject: material("snow") }, rename);
    expect(told).toEqual([]);
    expect(subject).toEqual(material("ice"));
});

test("code that somebody else deletes, or gives another name, is told or followed", () => {
    const code = "/primitives/rod/code";
    const ops = [remove("/nodes/stick")()[0], remove("/primitives/rod")()[0]];
    expect(after({ code }, () => ops as Operation[]).told).toEqual([
        "Rod deleted by somebody else.",
    ]);
    const rename = (before: SceneDocument) => {
        const found = findResource(before, "primitives", "rod") as Resource;
        return renameResource(before, SCHEMA, "primitives", found, "bar").ops;
    };
    expect(after({ code }, rename)).toMatchObject({ told: [], code: "/primitives/bar/code" });
});
