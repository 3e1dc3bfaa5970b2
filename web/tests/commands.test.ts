/* SPDX-License-Identifier: MIT */
import { expect, test, vi } from "vitest";
import type { App } from "../src/model/actions.ts";
import { addNode, whatAdding } from "../src/model/add.ts";
import type { Box } from "../src/model/camera.ts";
import { paste } from "../src/model/clipboard.ts";
import {
    commandById,
    commandForKey,
    runCommand,
    searchAbsent,
    searchCommands,
} from "../src/model/commandLookup.ts";
import { ABSENT, COMMANDS, type Command, type Context } from "../src/model/commands.ts";
import { isApart } from "../src/model/document.ts";
import { printDocument, readDocument } from "../src/model/documentJson.ts";
import { moveNodes, wrap } from "../src/model/edits.ts";
import { groundIn, seatOf } from "../src/model/fitting.ts";
import type { JsonObject } from "../src/model/json.ts";
import {
    isTaken,
    KEYMAPS,
    type KeyChoices,
    keysOf,
    overlap,
    rivalOf,
    takenKeys,
} from "../src/model/keymap.ts";
import type { KeyPress } from "../src/model/keys.ts";
import { fits } from "../src/model/moves.ts";
import type { Operation } from "../src/model/operation.ts";
import { apply } from "../src/model/operations.ts";
import type { Way } from "../src/model/placing.ts";
import { newResource } from "../src/model/resources.ts";
import {
    printSection,
    sectionAcross,
    sectionRange,
    sectionSeenFrom,
} from "../src/model/section.ts";
import { createStores } from "../src/model/stores.ts";
import { PREFERENCES, readPreferences } from "../src/model/view.ts";
import { SCHEMA, scene } from "./fixture.ts";

const CHOICES: KeyChoices = PREFERENCES;

/* A page without a server: edits apply to its document. */
function page(selection: readonly string[] = []) {
    const stores = createStores(null);
    stores.document.setState({ document: scene(), schema: SCHEMA, scene: "s" });
    stores.view.setState({ selection });
    const clipboard = { text: "" };
    const done: string[] = [];
    const app: App = {
        stores,
        edit: (ops: readonly Operation[], options) => {
            const { document } = stores.document.getState();
            const result = document && apply(document, ops, SCHEMA);
            if (!result?.ok) {
                throw new Error(result?.problem.message);
            }
            done.push(options?.label ?? "");
            stores.document.setState({ document: result.document });
            return true;
        },
        undo: () => void done.push("undo"),
        redo: () => void done.push("redo"),
        aspect: () => 1.5,
        bounds: (nodes) =>
            Promise.resolve(nodes[0] === "hat" ? { low: [1, 2, 3], high: [3, 4, 5] } : null),
        writeClipboard: (text) => {
            clipboard.text = text;
        },
        readClipboard: async () => clipboard.text,
        download: () => void done.push("download"),
        upload: () => void done.push("upload"),
        saveToLibrary: (node) => void done.push(`save ${node}`),
    };
    const run = (id: string): string | null => {
        const command = commandById(id);
        if (!command) {
            throw new Error(`no command ${id}`);
        }
        return runCommand(app, command);
    };
    const children = (id: string) => stores.document.getState().document?.nodes.get(id)?.children;
    return { app, stores, run, children, done, clipboard };
}

const press = (key: string, mods: string = "", code = ""): KeyPress => ({
    key,
    code,
    ctrlKey: mods.includes("c"),
    metaKey: mods.includes("m"),
    shiftKey: mods.includes("s"),
    altKey: mods.includes("a"),
});

test.each(KEYMAPS)("no key of %s means two commands in one place", (keymap) => {
    const choices = { ...CHOICES, keymap };
    for (const a of COMMANDS) {
        for (const b of COMMANDS) {
            if (a !== b && overlap(a.when, b.when)) {
                const keys = keysOf(b, COMMANDS, choices);
                expect(keysOf(a, COMMANDS, choices).filter((key) => keys.includes(key))).toEqual(
                    [],
                );
            }
        }
    }
});

test("a key of one's own stays when another keymap gives it to another command", () => {
    const keys = { "node.hide": "E", "camera.frame": "T" };
    for (const keymap of KEYMAPS) {
        const choices = { ...CHOICES, keymap, keys };
        for (const [id, key] of Object.entries(keys)) {
            const users = COMMANDS.filter((one) => keysOf(one, COMMANDS, choices).includes(key));
            expect(users.map((one) => one.id)).toEqual([id]);
        }
    }
    const unity: KeyChoices = { ...CHOICES, keymap: "unity", keys };
    const turn = commandById("hands.tool.turn") as Command;
    expect(keysOf(turn, COMMANDS, unity)).toEqual(["2"]);
    expect(takenKeys(COMMANDS, { ...unity, keymap: "fieldcast" })).toEqual([]);
    expect(takenKeys(COMMANDS, unity).map(({ key, by, from }) => [key, by.id, from.id])).toEqual([
        ["T", "camera.frame", "hands.turn"],
        ["E", "node.hide", "hands.tool.turn"],
    ]);
});

test("keys are those of another tool, or chosen ones, which are kept", () => {
    const of = (key: KeyPress, choices: KeyChoices) =>
        commandForKey(key, "anywhere", "no", choices)?.id;
    const w = press("w", "", "KeyW");
    const q = press("q", "", "KeyQ");
    const unity: KeyChoices = { ...CHOICES, keymap: "unity" };
    expect(of(w, CHOICES)).toBe("node.wrap");
    expect(of(w, unity)).toBe("hands.tool.move");
    expect(of(press("W", "s", "KeyW"), unity)).toBe("node.wrap");
    const chosen = readPreferences(JSON.stringify({ keys: { "node.hide": "Q", "node.wrap": "" } }));
    expect(of(q, chosen)).toBe("node.hide");
    expect(of(press("h", "", "KeyH"), chosen)).toBeUndefined();
    expect(of(w, chosen)).toBeUndefined();
    expect(readPreferences('{"keys":{"node.hide":7},"keymap":"x"}')).toMatchObject({
        keys: {},
        keymap: "fieldcast",
    });
});

test("a key is refused that is another command's in the same place, or the browser's", () => {
    const hide = commandById("node.hide") as Command;
    const rival = (key: string) => rivalOf(key, hide, COMMANDS, CHOICES)?.id;
    expect(rival("W")).toBe("node.wrap");
    expect(rival("H")).toBeUndefined();
    expect(rival("Q")).toBeUndefined();
    expect(["Tab", "Ctrl+N", "Esc", "Shift+F6", "Up", "Ctrl+Shift+Tab"].every(isTaken)).toBe(true);
    expect(["Q", "Ctrl+Shift+S", "Alt+Up", "F2"].some(isTaken)).toBe(false);
});

test("every command has an id of its own and a title", () => {
    expect(new Set(COMMANDS.map(({ id }) => id)).size).toBe(COMMANDS.length);
    expect(COMMANDS.filter(({ title }) => title === "")).toEqual([]);
});

test("keys that belong to the browser or to the focus are left alone", () => {
    const taken = ["Tab", "Shift+Tab", "Ctrl+N", "Ctrl+T", "Ctrl+W", "F5", "Ctrl+R", "Enter"];
    expect(COMMANDS.flatMap(({ keys }) => keys).filter((key) => taken.includes(key))).toEqual([]);
});

test.each<[KeyPress, Context, string | undefined]>([
    [press("k", "c", "KeyK"), "anywhere", "palette.open"],
    [press("k", "m", "KeyK"), "anywhere", "palette.open"],
    [press("A", "s", "KeyA"), "tree", "node.add"],
    [press("z", "c", "KeyZ"), "anywhere", "edit.undo"],
    [press("Z", "cs", "KeyZ"), "anywhere", "edit.redo"],
    [press("Delete"), "tree", "node.delete"],
    [press("d", "c", "KeyD"), "view", "node.duplicate"],
    [press("F2"), "tree", "node.rename"],
    [press("h", "", "KeyH"), "tree", "node.hide"],
    [press("m", "", "KeyM"), "tree", "node.hide"],
    [press("/", "", "Slash"), "view", "node.isolate"],
    [press("˙", "a", "KeyH"), "tree", "node.showAll"],
    [press("¡", "a", "Digit1"), "anywhere", "view.graph"],
    [press("2", "a", "Digit2"), "anywhere", "view.text"],
    [press("1", "a", "Numpad1"), "anywhere", undefined],
    [press("ArrowUp", "a"), "tree", "node.up"],
    [press("ArrowUp"), "view", "camera.orbit.up"],
    [press("ArrowUp"), "tree", undefined],
    [press("ArrowLeft", "s"), "view", "camera.pan.left"],
    [press("f", "", "KeyF"), "view", "camera.frame"],
    [press("1", "", "Numpad1"), "anywhere", "camera.front"],
    [press("1", "", "Digit1"), "anywhere", "hands.tool.move"],
    [press("9", "", "Digit9"), "anywhere", undefined],
    [press("+", "s", "Equal"), "view", "camera.nearer"],
    [press("?", "s", "Slash"), "anywhere", "help.keys"],
    [press("Escape"), "anywhere", "escape"],
])("%o in %s", (key, where, id) => {
    expect(commandForKey(key, where, "no", CHOICES)?.id).toBe(id);
});

test("a key typed into a field is no command, and single keys can be switched off", () => {
    expect(commandForKey(press("h", "", "KeyH"), "anywhere", "text", CHOICES)).toBeNull();
    expect(commandForKey(press("z", "c", "KeyZ"), "anywhere", "text", CHOICES)).toBeNull();
    expect(commandForKey(press("k", "c", "KeyK"), "anywhere", "text", CHOICES)?.id).toBe(
        "palette.open",
    );
    expect(
        commandForKey(press("h", "", "KeyH"), "anywhere", "no", { ...CHOICES, singleKeys: false }),
    ).toBeNull();
    expect(
        commandForKey(press("Delete"), "anywhere", "no", { ...CHOICES, singleKeys: false })?.id,
    ).toBe("node.delete");
});

test("delete leaves the neighbour selected; the root stays", () => {
    const { run, stores, children } = page(["body"]);
    expect(run("node.delete")).toBeNull();
    expect(children("neck")).toEqual(["head"]);
    expect(stores.view.getState().selection).toEqual(["head"]);
    stores.view.setState({ selection: ["root"] });
    expect(run("node.delete")).not.toBeNull();
    stores.view.setState({ selection: [] });
    expect(run("node.delete")).not.toBeNull();
});

test("duplicate puts a copy with new ids behind the original", () => {
    const { run, stores, children } = page(["neck"]);
    run("node.duplicate");
    expect(children("root")).toEqual(["neck", "neck-1", "hat", "stick"]);
    expect(children("neck-1")).toEqual(["body-1", "head-1"]);
    expect(stores.view.getState().selection).toEqual(["neck-1"]);
});

test("copy, cut and paste go through text", async () => {
    const { run, stores, children, clipboard } = page(["head"]);
    run("node.cut");
    expect(children("neck")).toEqual(["body"]);
    expect(JSON.parse(clipboard.text)).toMatchObject({ nodes: [{ id: "head" }] });
    stores.view.setState({ selection: ["hat"] });
    run("node.paste");
    await new Promise((resolve) => setTimeout(resolve));
    expect(children("root")).toEqual(["neck", "hat", "head-1", "stick"]);
    clipboard.text = "hello";
    run("node.paste");
    await new Promise((resolve) => setTimeout(resolve));
    expect(stores.notices.getState().notices.map(({ code }) => code)).toEqual([
        "deleted",
        "clipboard",
    ]);
});

test("a pasted node gives up a material that is not here", () => {
    const text = JSON.stringify({ nodes: [{ id: "n", type: "box", material: "tin" }] });
    const edit = paste(scene(), SCHEMA, [], text);
    expect(edit?.ops).toMatchObject([{ value: { id: "n-1", type: "box" } }]);
    expect(JSON.stringify(edit)).not.toContain("tin");
});

test("reorder steps among siblings and says when there is no further", () => {
    const { run, children } = page(["head"]);
    expect(run("node.up")).toBeNull();
    expect(children("neck")).toEqual(["head", "body"]);
    expect(run("node.up")).not.toBeNull();
    expect(run("node.down")).toBeNull();
    expect(children("neck")).toEqual(["body", "head"]);
});

test("wrap and dissolve are each other's way back", () => {
    const { app, run, stores, children } = page(["body", "head"]);
    const before = JSON.stringify(printDocument(scene()));
    run("node.wrap.difference");
    expect(children("neck")).toEqual(["difference-1"]);
    expect(children("difference-1")).toEqual(["body", "head"]);
    expect(run("node.dissolve")).toBeNull();
    const { document } = stores.document.getState();
    expect(document && JSON.stringify(printDocument(document))).toBe(before);
    expect(wrap(scene(), ["root"], "group").ops).toEqual([]);
    expect(app).toBeDefined();
});

test("undo and redo act in a field while nothing is typed there", () => {
    const [z, y] = [press("z", "c", "KeyZ"), press("y", "c", "KeyY")];
    expect(commandForKey(z, "anywhere", "unchanged", CHOICES)?.id).toBe("edit.undo");
    expect(commandForKey(y, "anywhere", "unchanged", CHOICES)?.id).toBe("edit.redo");
    expect(commandForKey(z, "anywhere", "text", CHOICES)).toBeNull();
    expect(commandForKey(press("h", "", "KeyH"), "anywhere", "unchanged", CHOICES)).toBeNull();
    expect(commandForKey(press("d", "c", "KeyD"), "anywhere", "unchanged", CHOICES)).toBeNull();
});

test("deleting says what is gone, with the step that brings it back", () => {
    const { run, stores, done } = page(["body"]);
    run("node.delete");
    const [notice] = stores.notices.getState().notices;
    expect(notice).toMatchObject({
        message: "Body deleted.",
        acts: [{ kind: "undo", label: done.at(-1) }],
    });
    stores.view.setState({ selection: ["hat", "stick"] });
    run("node.cut");
    expect(stores.notices.getState().notices.at(-1)?.message).toBe("2 nodes deleted.");
});

const added = (selection: string[], way: Way, type = "box") => {
    const edit = addNode(scene(), SCHEMA, { type }, selection, way);
    const result = apply(scene(), edit.ops, SCHEMA);
    if (!result.ok) {
        throw new Error(result.problem.message);
    }
    return (id: string) => result.document.nodes.get(id);
};

test("what is added combines as chosen, beside what is selected or into it", () => {
    expect(added([], "cut")("root")?.children).toEqual(["neck", "hat", "stick", "box-1"]);
    expect(added(["neck"], "blend")("neck")?.children).toEqual(["body", "head", "box-1"]);
    expect(added(["body"], "blend")("neck")?.children).toEqual(["body", "box-1", "head"]);
    expect(added(["neck"], "union")("root")?.children).toEqual(["neck", "box-1", "hat", "stick"]);
    const cut = added(["hat"], "cut");
    expect(cut("root")?.children).toEqual(["neck", "difference-1", "stick"]);
    expect(cut("difference-1")?.children).toEqual(["hat", "box-1"]);
    expect(added(["stick"], "union")("root")?.children).toEqual(["neck", "hat", "stick", "box-1"]);
    expect(addNode(scene(), SCHEMA, { type: "union" }, ["head"]).ops).toMatchObject([
        { op: "insert", into: "/nodes/neck" },
        { op: "move", at: "/nodes/head" },
    ]);
});

const MUG = readDocument({
    root: {
        id: "root",
        type: "union",
        children: [
            {
                id: "mug",
                type: "difference",
                children: [
                    { id: "outer", type: "sphere" },
                    { id: "inner", type: "sphere" },
                ],
            },
        ],
    },
});

test("nothing is cut that was not to be cut", () => {
    const after = (selection: string[], way: Way) => {
        const edit = addNode(MUG, SCHEMA, { type: "torus" }, selection, way);
        const result = apply(MUG, edit.ops, SCHEMA);
        return (id: string) => (result.ok ? result.document.nodes.get(id)?.children : undefined);
    };
    expect(after(["mug"], "union")("mug")).toEqual(["outer", "inner"]);
    expect(after(["mug"], "union")("root")).toEqual(["mug", "torus-1"]);
    expect(after(["mug"], "cut")("mug")).toEqual(["outer", "inner", "torus-1"]);
    /* Beside the first it would cut it; it becomes a part of it instead. */
    expect(after(["outer"], "union")("mug")).toEqual(["union-1", "inner"]);
    expect(after(["outer"], "union")("union-1")).toEqual(["outer", "torus-1"]);
    expect(after(["outer"], "cut")("mug")).toEqual(["outer", "torus-1", "inner"]);
    expect(after(["inner"], "cut")("mug")).toEqual(["outer", "difference-1"]);
    const pasted = paste(MUG, SCHEMA, ["mug"], JSON.stringify({ nodes: [{ type: "box" }] }));
    expect(pasted?.ops).toMatchObject([{ into: "/nodes/root" }]);
    const own = newResource(MUG, SCHEMA, "primitives", null, ["mug"]);
    expect(own.ops.at(-1)).toMatchObject({ into: "/nodes/root" });
    const what = (selection: string[], way: "union" | "cut") =>
        whatAdding(MUG, SCHEMA, { type: "torus" }, selection, way);
    expect(what(["mug"], "cut")).toEqual({ words: "Cuts mug.", way: "cut" });
    expect(what(["mug"], "union")).toEqual({ words: "Beside mug.", way: "union" });
    expect(what([], "union")).toEqual({ words: "Into root.", way: null });
});

test("a tool that is added leaves something of what it cuts, open at the top", () => {
    const seat = seatOf(MUG, SCHEMA, { type: "sphere" }, ["outer"], "cut");
    expect(seat).toMatchObject({ of: ["outer"], as: "tool" });
    const wide = { low: [1, -1, -1], high: [3, 3, 1] } as const;
    const ground = seat && groundIn(MUG, seat, wide);
    expect(ground).toEqual({ at: [2, 1.8, 0], normal: [0, 1, 0], size: 1.6 });
    const edit = addNode(MUG, SCHEMA, { type: "sphere" }, ["outer"], "cut", ground);
    expect(edit.ops.at(-1)).toMatchObject({
        value: { transform: { translation: [2, 1.8, 0], scale: 1.6 } },
    });
    expect(seatOf(MUG, SCHEMA, { type: "sphere" }, ["inner"], "cut")?.of).toEqual(["inner"]);
    expect(seatOf(MUG, SCHEMA, { type: "sphere" }, ["mug"], "cut")?.of).toEqual(["outer"]);
    expect(seatOf(MUG, SCHEMA, { type: "sphere" }, ["outer"], "union")).toBeNull();
    expect(seatOf(MUG, SCHEMA, { type: "union" }, ["outer"], "cut")).toBeNull();
});

test("what is added to blend begins at the side of what it blends with, in sight", () => {
    const seat = seatOf(MUG, SCHEMA, { type: "torus" }, ["outer"], "blend");
    expect(seat).toMatchObject({ of: ["outer"], as: "side" });
    const box = { low: [-3, -0.5, -1], high: [1, 1.5, 1] } as const;
    expect(seat && groundIn(MUG, seat, box)).toEqual({ at: [1, 0.5, 0], normal: [0, 1, 0] });
    expect(seatOf(MUG, SCHEMA, { type: "torus" }, [], "blend")).toBeNull();
    expect(seatOf(MUG, SCHEMA, { type: "torus" }, ["outer"], "union")).toBeNull();
});

test("a plane that is added lies under all that is there", () => {
    const seat = seatOf(MUG, SCHEMA, { type: "plane" }, [], "union");
    expect(seat).toMatchObject({ of: ["outer", "inner"], as: "floor" });
    const box = { low: [-3, -0.5, -1], high: [1, 1, 1] } as const;
    expect(seat && groundIn(MUG, seat, box)).toEqual({ at: [0, -0.5, 0], normal: [0, 1, 0] });
    const wall = { id: "wall", type: "plane" };
    const seatBeside = (children: JsonObject[]) => {
        const document = readDocument({ root: { id: "root", type: "union", children } });
        return seatOf(document, SCHEMA, { type: "plane" }, [], "union");
    };
    expect(seatBeside([wall, { id: "ball", type: "sphere" }])?.of).toEqual(["ball"]);
    expect(seatBeside([wall])).toBeNull();
    expect(seatBeside([])).toBeNull();
});

test("a scene that is one difference says that an addition cuts", () => {
    const document = readDocument({ root: { id: "all", type: "difference", children: [] } });
    const what = whatAdding(document, SCHEMA, { type: "box" }, [], "union");
    expect(what).toEqual({ words: "Cuts all.", way: null });
});

test("what is new has a name for people, each its own", () => {
    const edit = addNode(scene(), SCHEMA, { type: "smooth_union" }, []);
    expect(edit.ops).toMatchObject([{ value: { id: "smooth_union-1", name: "Smooth union" } }]);
    const { run, stores } = page(["hat"]);
    run("node.duplicate");
    run("node.duplicate");
    const { nodes } = stores.document.getState().document ?? scene();
    expect(["hat", "hat-1", "hat-2"].map((id) => nodes.get(id)?.common.name)).toEqual([
        "Hat",
        "Hat 2",
        "Hat 3",
    ]);
    stores.view.setState({ selection: ["head", "body"] });
    run("node.wrap.union");
    expect(stores.document.getState().document?.nodes.get("union-1")?.common.name).toBe("Union");
});

test("moving before a node that moves along goes before the next that stays", () => {
    const edit = moveNodes(scene(), ["body", "head"], { into: "neck", before: "body" });
    expect(apply(scene(), edit.ops, SCHEMA).ok).toBe(true);
    expect(edit.ops.at(-1)).toMatchObject({ before: null });
});

test("a node fits into what holds others, but not into itself, nor a model into itself", () => {
    const into = (id: string, target: string): boolean => fits(SCHEMA, scene(), [id], target);
    expect(into("hat", "neck")).toBe(true);
    expect(into("hat", "head")).toBe(false);
    expect(into("neck", "neck")).toBe(false);
    expect(into("root", "neck")).toBe(false);
    expect(into("rook-pawn", "root")).toBe(true);
    expect(into("rook-pawn", "pawn-root")).toBe(false);
});

test("the shelf is a hidden group at the root, made once, and gives back what it holds", () => {
    const { run, stores, children, done } = page(["head"]);
    expect(run("node.unpark")).toBe("It is not on the shelf.");
    expect(run("node.park")).toBe(null);
    expect(children("root")).toEqual(["neck", "hat", "stick", "shelf-1"]);
    expect(children("shelf-1")).toEqual(["head"]);
    const { document } = stores.document.getState();
    expect(document?.nodes.get("shelf-1")?.common).toEqual({ name: "Shelf", visible: false });
    expect(stores.view.getState().selection).toEqual(["head"]);
    expect(run("node.park")).toBe("It is on the shelf already.");
    stores.view.setState({ selection: ["stick"] });
    run("node.park");
    expect(children("shelf-1")).toEqual(["head", "stick"]);
    expect(done).toEqual(["put head on the shelf", "put stick on the shelf"]);
    stores.view.setState({ selection: ["head"] });
    run("node.unpark");
    expect(children("root")).toEqual(["neck", "hat", "head", "shelf-1"]);
    stores.view.setState({ selection: ["shelf-1"] });
    expect(run("node.park")).toBe("It is on the shelf already.");
});

test("what is put on a shelf stays where it is, in the tree that it is of", () => {
    const { app, run, stores, children } = page(["hat"]);
    run("node.park");
    const at = "/nodes/shelf-1/transform/translation";
    app.edit([{ op: "set", at, value: [0, 2, 0] }]);
    stores.view.setState({ selection: ["head", "foot"] });
    run("node.park");
    expect(children("shelf-1")).toEqual(["hat", "head"]);
    expect(children("pawn-root")).toEqual(["foot"]);
    const head = stores.document.getState().document?.nodes.get("head");
    expect(head?.transform.translation).toEqual([0, -0.7, 0]);
    stores.view.setState({ selection: ["foot"] });
    run("node.park");
    expect(children("pawn-root")).toEqual(["shelf-2"]);
    expect(children("shelf-2")).toEqual(["foot"]);
});

test("neither the scene nor the camera changes under a hand; another motion takes over", () => {
    const { stores, run, done } = page(["head"]);
    const { camera } = stores.camera.getState();
    const why = "Let go first of what is held in the picture, or press Esc.";
    stores.document.setState({ canUndo: true });
    stores.view.setState({ held: true });
    for (const id of ["edit.undo", "node.delete", "hands.turn", "camera.left"]) {
        expect(run(id)).toBe(why);
    }
    expect(done).toEqual([]);
    stores.view.setState({ motion: "move" });
    expect(run("hands.turn")).toBeNull();
    expect(stores.view.getState().motion).toBe("turn");
    stores.view.setState({ held: false, motion: null });
    expect(run("edit.undo")).toBeNull();
    expect(done).toEqual(["undo"]);
    expect(run("camera.left")).toBeNull();
    expect(stores.camera.getState().camera).not.toEqual(camera);
});

test("hide and show all", () => {
    const { run, stores } = page(["head"]);
    const hidden = () =>
        [...(stores.document.getState().document?.nodes.values() ?? [])]
            .filter((node) => node.common.visible === false)
            .map((node) => node.id);
    run("node.hide");
    expect(hidden()).toEqual(["head", "hat"]);
    run("node.hide");
    expect(hidden()).toEqual(["hat"]);
    run("node.showAll");
    expect(hidden()).toEqual([]);
    expect(run("node.showAll")).not.toBeNull();
});

test("to isolate is no edit, and ends by the same key, Escape, or showing all", () => {
    const { run, stores, done } = page(["head", "hat"]);
    const isolated = () => stores.view.getState().isolated;
    for (const end of ["node.isolate", "escape", "node.showAll"]) {
        stores.view.setState({ selection: ["head", "neck"] });
        expect(run("node.isolate")).toBeNull();
        expect(isolated()).toEqual(["neck"]);
        stores.view.setState({ selection: [] });
        expect(run(end)).toBeNull();
        expect(isolated()).toEqual([]);
    }
    expect(run("node.isolate")).not.toBeNull();
    expect(done).toEqual([]);
    expect(commandForKey(press("H", "s", "KeyH"), "tree", "no", CHOICES)?.id).toBe("node.isolate");
});

test("a section is no edit, looks at the cut, and ends by the same key or Escape", async () => {
    const { run, stores, done } = page(["head"]);
    const section = () => stores.view.getState().section;
    const { camera } = stores.camera.getState();
    stores.camera.setState({ camera: { ...camera, position: [-9, 1, 2], target: [0, 0, 0] } });
    for (const end of ["view.section", "escape"]) {
        expect(run("view.section")).toBeNull();
        await vi.waitFor(() => expect(section()).not.toBeNull());
        expect(section()).toMatchObject({ axis: "x", flipped: true });
        expect(run(end)).toBeNull();
        expect(section()).toBeNull();
        expect(stores.view.getState().selection).toEqual(["head"]);
    }
    expect(done).toEqual([]);
    expect(commandForKey(press("k", "", "KeyK"), "view", "no", CHOICES)?.id).toBe("view.section");
});

test("a section goes through the box of what is shown, where the server knows it", async () => {
    const { run, stores } = page();
    run("view.section");
    await vi.waitFor(() => expect(stores.view.getState().section).not.toBeNull());
    const { low, high } = stores.view.getState().extent;
    expect(high[1] - low[1]).toBeCloseTo(high[0] - low[0], 9);
    run("view.section");
    await vi.waitFor(() => expect(stores.view.getState().section).toBeNull());
    stores.view.setState({ isolated: ["hat"] });
    run("view.section");
    await vi.waitFor(() => expect(stores.view.getState().section).not.toBeNull());
    expect(stores.view.getState()).toMatchObject({
        section: { axis: "x", at: 2, flipped: true },
        extent: { low: [1, 2, 3], high: [3, 4, 5] },
    });
});

test("a section is told to the server as a plane, whichever side is kept", () => {
    const box: Box = { low: [-1, 1, 1], high: [3, 3, 5] };
    const section = sectionSeenFrom([1.5, 9, 3], box);
    expect(section).toEqual({ axis: "y", at: 2, flipped: false });
    expect(printSection({ ...section, at: 2.5 })).toEqual({ normal: [0, 1, 0], offset: 2.5 });
    expect(printSection({ ...section, at: 2.5, flipped: true })).toEqual({
        normal: [0, -1, 0],
        offset: -2.5,
    });
    expect(sectionAcross({ ...section, flipped: true }, "z", box)).toEqual({
        axis: "z",
        at: 3,
        flipped: true,
    });
    expect(sectionRange("x", box)).toEqual({ low: -1, high: 3 });
    expect(sectionRange("y", box)).toEqual({ low: 1, high: 3 });
});

test("Escape ends an isolation before it deselects", () => {
    const { run, stores } = page(["head"]);
    run("node.isolate");
    run("escape");
    expect(stores.view.getState()).toMatchObject({ isolated: [], selection: ["head"] });
});

test("apart from isolated nodes is what is neither below nor around them", () => {
    const document = scene();
    const apart = (isolated: string[]) =>
        [...document.nodes.keys()].filter((id) => isApart(document, isolated, id));
    expect(apart([])).toEqual([]);
    expect(apart(["head"])).toEqual(["body", "hat", "stick"]);
    expect(apart(["neck"])).toEqual(["hat", "stick"]);
    expect(apart(["head", "stick"])).toEqual(["body", "hat"]);
});

test("Escape peels one layer at a time", () => {
    const { run, stores } = page(["head"]);
    stores.view.setState({ popup: "add", renaming: "head" });
    run("escape");
    expect(stores.view.getState()).toMatchObject({ renaming: null, popup: "add" });
    run("escape");
    expect(stores.view.getState()).toMatchObject({ popup: null, selection: ["head"] });
    run("escape");
    expect(stores.view.getState().selection).toEqual([]);
    expect(run("escape")).not.toBeNull();
});

test("the camera moves without an edit until it is saved", async () => {
    const { run, stores, done } = page(["head"]);
    const target = () => stores.camera.getState().camera.target;
    run("camera.orbit.left");
    run("camera.frame");
    await vi.waitFor(() => expect(target()).toEqual([0, 1.3, 0])); /* no box is known */
    expect(stores.camera.getState().own).toBe(true);
    stores.view.setState({ selection: ["hat"] });
    run("camera.frame");
    await vi.waitFor(() => expect(target()).toEqual([2, 3, 4]));
    stores.view.setState({ selection: ["head"] });
    run("camera.frame");
    const { scene } = stores.document.getState();
    stores.document.setState({ scene: "another" });
    await new Promise((done) => setTimeout(done));
    expect(target()).toEqual([2, 3, 4]);
    stores.document.setState({ scene });
    expect(done).toEqual([]);
    run("camera.save");
    expect(done).toEqual(["set camera"]);
    expect(stores.camera.getState().own).toBe(false);
});

test("the palette finds by any words of the title", () => {
    expect(searchCommands("dup")[0]?.id).toBe("node.duplicate");
    expect(searchCommands("everything frame")[0]?.id).toBe("camera.home");
    expect(searchCommands("xyzzy")).toEqual([]);
    expect(searchCommands("").some(({ keyOnly }) => keyOnly)).toBe(false);
});

test("commands are found by other words, and what there is not is told", () => {
    const first = (query: string) => searchCommands(query)[0]?.id;
    expect(first("export image")).toBe("scene.picture");
    expect(first("solo")).toBe("node.isolate");
    expect(searchCommands("history").map(({ id }) => id)).toContain("edit.undo");
    for (const word of [
        "export",
        "share",
        "history",
        "measure",
        "grid",
        "graph",
        "equation",
        "formula",
        "move",
        "gizmo",
    ]) {
        const found = searchCommands(word).length + searchAbsent(word).length;
        expect(found, word).toBeGreaterThan(0);
    }
    expect(searchAbsent("mesh")[0]?.answer).toContain("JSON");
    expect(searchAbsent("")).toEqual([]);
});

test("what there is not has no word of a command", () => {
    const split = (...texts: string[]) =>
        texts
            .join(" ")
            .toLowerCase()
            .match(/[a-z0-9]+/g) ?? [];
    const known = new Set(COMMANDS.flatMap(({ id, title, words }) => split(id, title, words)));
    expect(
        ABSENT.flatMap(({ title, words }) => split(title, words)).filter((word) => known.has(word)),
    ).toEqual([]);
});

test("preferences survive, broken ones do not spread", () => {
    const kept = new Map<string, string>([
        ["fieldcast.preferences", '{"theme":"dark","panels":5}'],
    ]);
    const storage = {
        getItem: (key: string) => kept.get(key) ?? null,
        setItem: (key: string, value: string) => void kept.set(key, value),
    };
    const first = createStores(storage).view;
    expect(first.getState().preferences).toMatchObject({
        theme: "dark",
        panels: { scene: true, inspector: true },
    });
    first.setState(({ preferences }) => ({ preferences: { ...preferences, quality: "sharp" } }));
    expect(createStores(storage).view.getState().preferences.quality).toBe("sharp");
});
