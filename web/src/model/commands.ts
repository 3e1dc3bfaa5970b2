/* SPDX-License-Identifier: MIT */
/* THE TABLE of commands: palette, menus, tooltips, key sheet and key handling are made from it. */
import {
    type App,
    canDissolve,
    canReorder,
    climb,
    copyNodes,
    documentOf,
    dollyBy,
    editModel,
    frameNodes,
    hiddenNodes,
    hideNodes,
    hideOthers,
    lookFrom,
    needsInstance,
    needsLens,
    needsMovable,
    needsOne,
    needsScene,
    needsSelection,
    never,
    next,
    onDocument,
    orbitBy,
    panBy,
    pasteNodes,
    saveCamera,
    saved,
    selectionOf,
    showAll,
} from "./actions.ts";
import { dissolve, duplicate, removeNodes, reorder, wrap } from "./edits.ts";
import { makeModel, unpackModel } from "./models.ts";
import { outputsShown } from "./schema.ts";
import { type Stores, setPreferences } from "./stores.ts";
import { text } from "./texts.ts";
import { COLOR, peel, type Theme, type View } from "./view.ts";

/* Where a key works: `anywhere` outside of text fields, or only with the focus in that region. */
export type Context = "anywhere" | "view" | "tree";

export interface Command {
    readonly id: string;
    readonly title: string;
    readonly group: "scene" | "edit" | "select" | "camera" | "view" | "help";
    /* "Ctrl+Shift+Z"; the first is shown. Ctrl is Cmd on a Mac. */
    readonly keys: readonly string[];
    readonly when: Context;
    /* Also acts while a text field has the focus. */
    readonly inFields: boolean;
    /* Not in the palette: it makes sense as a key only. */
    readonly keyOnly: boolean;
    /* Why it cannot run now, for the tooltip; null: it can. */
    readonly whyNot: (app: App) => string | null;
    readonly run: (app: App) => void;
}

/* --- the table --- */

const THEMES: readonly Theme[] = ["auto", "light", "dark"];

type Row = Pick<Command, "id" | "title" | "group" | "run"> & Partial<Command>;

const row = (part: Row): Command => ({
    keys: [],
    when: "anywhere",
    inFields: false,
    keyOnly: false,
    whyNot: needsScene,
    ...part,
});

const show =
    (part: Partial<View> | ((view: View) => Partial<View>)) =>
    (app: App): void =>
        app.stores.view.setState(part);

/* What help is asked about: the type of the selected node. */
function topicOf({ document, view }: Stores): string | null {
    const active = view.getState().selection.at(-1) ?? "";
    return document.getState().document?.nodes.get(active)?.type ?? null;
}

export const COMMANDS: readonly Command[] = [
    row({
        id: "palette.open",
        title: "Commands",
        group: "help",
        keys: ["Ctrl+K", "F3", "Ctrl+/"],
        inFields: true,
        keyOnly: true,
        whyNot: never,
        run: show({ popup: "commands" }),
    }),
    row({
        id: "node.add",
        title: "Add …",
        group: "edit",
        keys: ["Shift+A"],
        run: show({ popup: "add" }),
    }),
    row({
        id: "edit.undo",
        title: "Undo",
        group: "edit",
        keys: ["Ctrl+Z"],
        whyNot: (app) => (app.stores.document.getState().canUndo ? null : text("why.nothingUndo")),
        run: (app) => app.undo(),
    }),
    row({
        id: "edit.redo",
        title: "Redo",
        group: "edit",
        keys: ["Ctrl+Shift+Z", "Ctrl+Y"],
        whyNot: (app) => (app.stores.document.getState().canRedo ? null : text("why.nothingRedo")),
        run: (app) => app.redo(),
    }),
    row({
        id: "node.delete",
        title: "Delete",
        group: "edit",
        keys: ["Delete", "Backspace"],
        whyNot: needsMovable(1),
        run: onDocument(removeNodes),
    }),
    row({
        id: "node.duplicate",
        title: "Duplicate",
        group: "edit",
        keys: ["Ctrl+D"],
        whyNot: needsMovable(1),
        run: onDocument(duplicate),
    }),
    row({
        id: "node.copy",
        title: "Copy",
        group: "edit",
        keys: ["Ctrl+C"],
        whyNot: needsMovable(1),
        run: copyNodes,
    }),
    row({
        id: "node.cut",
        title: "Cut",
        group: "edit",
        keys: ["Ctrl+X"],
        whyNot: needsMovable(1),
        run: (app) => {
            copyNodes(app);
            onDocument(removeNodes)(app);
        },
    }),
    row({
        id: "node.paste",
        title: "Paste",
        group: "edit",
        keys: ["Ctrl+V"],
        run: (app) => void pasteNodes(app),
    }),
    row({
        id: "node.rename",
        title: "Rename",
        group: "edit",
        keys: ["F2"],
        whyNot: needsOne,
        run: (app) => app.stores.view.setState({ renaming: selectionOf(app)[0] ?? null }),
    }),
    row({
        id: "node.group",
        title: "Wrap in a group",
        group: "edit",
        keys: ["Ctrl+G"],
        whyNot: needsMovable(1),
        run: onDocument((document, ids) => wrap(document, ids, "group")),
    }),
    row({
        id: "node.dissolve",
        title: "Dissolve, keep the children",
        group: "edit",
        keys: ["Ctrl+Shift+G"],
        whyNot: canDissolve,
        run: onDocument((document, ids) => dissolve(document, ids[0] ?? "")),
    }),
    ...(
        [
            ["union", "U", "a union"],
            ["intersection", "I", "an intersection"],
            ["difference", "D", "a difference"],
            ["smooth_union", "B", "a smooth union"],
        ] as const
    ).map(([type, key, words]) =>
        row({
            id: `node.wrap.${type}`,
            title: `Wrap in ${words}`,
            group: "edit",
            keys: [key],
            whyNot: needsMovable(2),
            run: onDocument((document, ids) => wrap(document, ids, type)),
        }),
    ),
    row({
        id: "node.wrap",
        title: "Wrap in …",
        group: "edit",
        keys: ["W"],
        whyNot: needsMovable(1),
        run: show({ popup: "wrap" }),
    }),
    row({
        id: "model.make",
        title: "Make a model of it",
        group: "edit",
        keys: ["Ctrl+Alt+K"],
        whyNot: needsMovable(1),
        run: onDocument((document, ids, schema) => makeModel(document, schema, ids)),
    }),
    row({
        id: "model.edit",
        title: "Edit its model",
        group: "edit",
        whyNot: needsInstance,
        run: editModel,
    }),
    row({
        id: "model.unpack",
        title: "Unpack the instance",
        group: "edit",
        whyNot: needsInstance,
        run: onDocument((document, ids, schema) => unpackModel(document, schema, ids[0] ?? "")),
    }),
    row({
        id: "node.up",
        title: "Move up among its siblings",
        group: "edit",
        keys: ["Alt+Up"],
        whyNot: canReorder(-1),
        run: onDocument((document, ids) => reorder(document, ids[0] ?? "", -1)),
    }),
    row({
        id: "node.down",
        title: "Move down among its siblings",
        group: "edit",
        keys: ["Alt+Down"],
        whyNot: canReorder(1),
        run: onDocument((document, ids) => reorder(document, ids[0] ?? "", 1)),
    }),
    row({
        id: "node.hide",
        title: "Hide or show",
        group: "edit",
        keys: ["H"],
        whyNot: needsSelection,
        run: hideNodes,
    }),
    row({
        id: "node.hideOthers",
        title: "Hide everything else",
        group: "edit",
        keys: ["Shift+H"],
        whyNot: needsSelection,
        run: hideOthers,
    }),
    row({
        id: "node.showAll",
        title: "Show everything",
        group: "edit",
        keys: ["Alt+H"],
        whyNot: (app) => {
            const document = documentOf(app);
            return document && hiddenNodes(document).length > 0 ? null : text("why.allVisible");
        },
        run: showAll,
    }),
    row({
        id: "select.all",
        title: "Select all parts",
        group: "select",
        keys: ["Ctrl+A"],
        run: (app) => {
            const document = documentOf(app);
            const root = document?.nodes.get(document.root);
            app.stores.view.setState({ selection: root?.children ?? [] });
        },
    }),
    row({
        id: "select.parent",
        title: "Select the parent",
        group: "select",
        keys: ["P"],
        whyNot: needsSelection,
        run: climb,
    }),
    row({
        id: "escape",
        title: "Close or deselect",
        group: "select",
        keys: ["Esc"],
        inFields: true,
        keyOnly: true,
        whyNot: (app) => (peel(app.stores.view.getState()) ? null : text("why.top")),
        run: (app) => app.stores.view.setState((view) => peel(view) ?? {}),
    }),
    row({
        id: "camera.frame",
        title: "Frame the selection",
        group: "camera",
        keys: ["F"],
        run: (app) => {
            const ids = selectionOf(app);
            frameNodes(app, ids.length > 0 ? ids : undefined);
        },
    }),
    row({
        id: "camera.home",
        title: "Frame everything",
        group: "camera",
        keys: ["Home"],
        run: (app) => frameNodes(app),
    }),
    row({
        id: "camera.document",
        title: "Back to the scene's camera",
        group: "camera",
        keys: ["Num0"],
        run: (app) => app.stores.camera.setState({ own: false }),
    }),
    row({
        id: "camera.save",
        title: "Save this camera to the scene",
        group: "camera",
        run: saveCamera,
    }),
    row({
        id: "camera.focus",
        title: "Focus on what is clicked next",
        group: "camera",
        whyNot: needsLens,
        run: show({ aiming: true }),
    }),
    ...(
        [
            ["front", "Num1"],
            ["right", "Num3"],
            ["top", "Num7"],
            ["back", "Ctrl+Num1"],
            ["left", "Ctrl+Num3"],
            ["bottom", "Ctrl+Num7"],
        ] as const
    ).map(([name, key]) =>
        row({
            id: `camera.${name}`,
            title: `Look from the ${name}`,
            group: "camera",
            keys: [key],
            run: lookFrom(name),
        }),
    ),
    ...(
        [
            ["left", "Left", -1, 0],
            ["right", "Right", 1, 0],
            ["up", "Up", 0, 1],
            ["down", "Down", 0, -1],
        ] as const
    ).flatMap(([name, key, x, y]) => [
        row({
            id: `camera.orbit.${name}`,
            title: `Orbit ${name}`,
            group: "camera",
            keys: [key],
            when: "view",
            run: orbitBy(x, y),
        }),
        row({
            id: `camera.pan.${name}`,
            title: `Pan ${name}`,
            group: "camera",
            keys: [`Shift+${key}`],
            when: "view",
            run: panBy(x, y),
        }),
    ]),
    row({
        id: "camera.nearer",
        title: "Nearer",
        group: "camera",
        keys: ["+", "="],
        run: dollyBy(1),
    }),
    row({
        id: "camera.farther",
        title: "Farther",
        group: "camera",
        keys: ["-"],
        run: dollyBy(-1),
    }),
    row({
        id: "view.output",
        title: "Next output: colour, depth, normals …",
        group: "view",
        keys: ["Z"],
        run: ({ stores }) => {
            const names = outputsShown(stores.document.getState().schema).map(({ name }) => name);
            stores.view.setState(({ aov }) => ({ aov: next(names, aov) }));
        },
    }),
    row({
        id: "view.color",
        title: "Back to the colours",
        group: "view",
        keys: ["Shift+Z"],
        whyNot: ({ stores }) => (stores.view.getState().aov === COLOR ? text("why.colors") : null),
        run: show({ aov: COLOR }),
    }),
    row({
        id: "view.chrome",
        title: "Hide or show the panels",
        group: "view",
        keys: ["Ctrl+\\"],
        inFields: true,
        whyNot: never,
        run: show(({ chromeHidden }) => ({ chromeHidden: !chromeHidden })),
    }),
    row({
        id: "view.statistics",
        title: "Statistics",
        group: "view",
        run: show({ popup: "statistics" }),
    }),
    row({
        id: "view.theme",
        title: "Next theme: as the system, light, dark",
        group: "view",
        whyNot: never,
        run: ({ stores }) =>
            setPreferences(stores.view, {
                theme: next(THEMES, stores.view.getState().preferences.theme),
            }),
    }),
    row({
        id: "view.hints",
        title: "Show the hints again",
        group: "help",
        whyNot: never,
        run: ({ stores }) => setPreferences(stores.view, { hintsDone: [] }),
    }),
    row({
        id: "scene.open",
        title: "Scenes",
        group: "scene",
        keys: ["Ctrl+O"],
        whyNot: never,
        run: show({ popup: "scenes" }),
    }),
    row({
        id: "scene.save",
        title: "Is it saved?",
        group: "scene",
        keys: ["Ctrl+S"],
        inFields: true,
        run: saved,
    }),
    row({
        id: "scene.download",
        title: "Download as JSON",
        group: "scene",
        run: (app) => app.download(),
    }),
    row({
        id: "scene.picture",
        title: "Download a picture …",
        group: "scene",
        keys: ["Ctrl+Shift+S"],
        inFields: true,
        run: show({ popup: "picture" }),
    }),
    row({
        id: "scene.upload",
        title: "Open a scene file",
        group: "scene",
        whyNot: never,
        run: (app) => app.upload(),
    }),
    row({
        id: "help.reference",
        title: "Reference of all types",
        group: "help",
        keys: ["F1"],
        whyNot: never,
        run: ({ stores }) => stores.view.setState({ popup: "reference", topic: topicOf(stores) }),
    }),
    row({
        id: "help.keys",
        title: "Keys and gestures",
        group: "help",
        keys: ["?"],
        whyNot: never,
        run: show({ popup: "help" }),
    }),
];
