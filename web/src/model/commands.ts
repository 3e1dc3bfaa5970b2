/* SPDX-License-Identifier: MIT */
/* THE TABLE of commands: palette, menus, tooltips, key sheet and key handling are made from it. */
import {
    type App,
    canDissolve,
    canMove,
    canPark,
    canReorder,
    canUnpark,
    changeHands,
    chooseTool,
    climb,
    copyNodes,
    deleteNodes,
    documentOf,
    dollyBy,
    editModel,
    frameNodes,
    hiddenNodes,
    hideNodes,
    isIsolating,
    isolate,
    lookFrom,
    needsInstance,
    needsLens,
    needsMovable,
    needsOne,
    needsPart,
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
    toggleSection,
} from "./actions.ts";
import { dissolve, duplicate, reorder, wrap } from "./edits.ts";
import { PIVOTS, SPACES } from "./hands.ts";
import { makeModel, unpackModel } from "./models.ts";
import { park, unpark } from "./moves.ts";
import { outputsShown } from "./schema.ts";
import { type Stores, setPreferences } from "./stores.ts";
import { text } from "./texts.ts";
import { COLOR, peel, type Theme, toggleDrawer, type View } from "./view.ts";

/* Where a key works: `anywhere` outside of text fields, or only with the focus in that region. */
export type Context = "anywhere" | "view" | "tree";

export interface Command {
    readonly id: string;
    readonly title: string;
    /* Other words that it is looked for by. */
    readonly words: string;
    readonly group: "scene" | "edit" | "select" | "camera" | "view" | "help";
    /* "Ctrl+Shift+Z"; the first is shown. Ctrl is Cmd on a Mac. */
    readonly keys: readonly string[];
    readonly when: Context;
    /* Also acts while a text field has the focus; `unchanged`: only while nothing was typed there. */
    readonly inFields: boolean | "unchanged";
    /* Not in the palette: it makes sense as a key only. */
    readonly keyOnly: boolean;
    /* Takes the place of what keys hold in the picture. */
    readonly takesOver: boolean;
    /* Why it cannot run now, for the tooltip; null: it can. */
    readonly whyNot: (app: App) => string | null;
    readonly run: (app: App) => void;
}

/* --- the table --- */

const THEMES: readonly Theme[] = ["auto", "light", "dark"];

/* What people look for and there is not: an honest answer each, and the way there is. None of the
 * words finds a command. */
export interface Absent {
    readonly words: string;
    readonly title: string;
    readonly answer: string;
}

export const ABSENT: readonly Absent[] = [
    {
        words: "share link invite collaborate embed",
        title: "Share",
        answer: "The address of this page is the link: whoever opens it edits along.",
    },
    {
        words: "mesh stl obj gltf glb 3mf print",
        title: "Meshes",
        answer: "There are no meshes: a scene is downloaded as JSON, a picture as PNG, JPEG, NPY or HDR.",
    },
    {
        words: "equation formula implicit function parametric expression math",
        title: "Equations",
        answer: "Add the shape Implicit and type an equation in x, y and z, or the shape Parametric and type a surface in two parameters.",
    },
    {
        words: "versions checkpoint timeline",
        title: "Versions",
        answer: "Ctrl+Z takes your steps back, also after a reload. There is no list of them.",
    },
    {
        words: "animation animate keyframe video play",
        title: "Animation",
        answer: "There is none: scenes stand still.",
    },
    {
        words: "texture uv map",
        title: "Textures",
        answer: "There are none on surfaces. Write a shader, or set a picture as the backdrop.",
    },
];

type Row = Pick<Command, "id" | "title" | "group" | "run"> & Partial<Command>;

const row = (part: Row): Command => ({
    keys: [],
    words: "",
    when: "anywhere",
    inFields: false,
    keyOnly: false,
    takesOver: false,
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

type Switch = "grid" | "marks" | "outlines" | "probe" | "thumbnails" | "singleKeys";

const toggle =
    (name: Switch) =>
    ({ stores: { view } }: App): void =>
        setPreferences(view, { [name]: !view.getState().preferences[name] });

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
        words: "new insert create shape object primitive",
        title: "Add …",
        group: "edit",
        keys: ["Shift+A"],
        run: show({ popup: "add" }),
    }),
    row({
        id: "edit.undo",
        words: "back history revert",
        title: "Undo",
        group: "edit",
        keys: ["Ctrl+Z"],
        inFields: "unchanged",
        whyNot: (app) => (app.stores.document.getState().canUndo ? null : text("why.nothingUndo")),
        run: (app) => app.undo(),
    }),
    row({
        id: "edit.redo",
        words: "forward history again",
        title: "Redo",
        group: "edit",
        keys: ["Ctrl+Shift+Z", "Ctrl+Y"],
        inFields: "unchanged",
        whyNot: (app) => (app.stores.document.getState().canRedo ? null : text("why.nothingRedo")),
        run: (app) => app.redo(),
    }),
    ...(
        [
            ["move", "Move", "G", "1", "translate grab drag place"],
            ["turn", "Rotate", "R", "2", "turn spin orient"],
            ["scale", "Scale", "S", "3", "size grow shrink"],
        ] as const
    ).flatMap(([motion, title, key, digit, words]) => [
        row({
            id: `hands.${motion}`,
            title: `${title} with the pointer`,
            words: `${words} X Y Z digits`,
            group: "edit",
            keys: [key],
            takesOver: true,
            whyNot: canMove(motion),
            run: show({ motion }),
        }),
        row({
            id: `hands.tool.${motion}`,
            title: `${title}: show the gizmo, or none`,
            words: `${words} tool handle arrows rings`,
            group: "view",
            keys: [digit],
            run: chooseTool(motion),
        }),
    ]),
    row({
        id: "hands.space",
        title: "Axes of the gizmo: world, local, parent",
        words: "orientation global",
        group: "view",
        keys: ["L"],
        run: changeHands(({ space }) => ({ space: next(SPACES, space) })),
    }),
    row({
        id: "hands.pivot",
        title: "Pivot: middle, origin, each its own",
        words: "center origin about turn scale",
        group: "view",
        run: changeHands(({ pivot }) => ({ pivot: next(PIVOTS, pivot) })),
    }),
    row({
        id: "hands.snap",
        title: "Move in steps, or freely",
        words: "snap grid increment",
        group: "view",
        keys: ["Shift+M"],
        run: changeHands(({ snap }) => ({ snap: !snap })),
    }),
    row({
        id: "node.delete",
        words: "remove erase",
        title: "Delete",
        group: "edit",
        keys: ["Delete", "Backspace"],
        whyNot: needsMovable(1),
        run: deleteNodes,
    }),
    row({
        id: "node.duplicate",
        words: "copy clone array",
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
            deleteNodes(app);
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
        words: "name label",
        title: "Rename",
        group: "edit",
        keys: ["F2"],
        whyNot: needsOne,
        run: (app) => app.stores.view.setState({ renaming: selectionOf(app)[0] ?? null }),
    }),
    row({
        id: "node.group",
        words: "folder parent",
        title: "Wrap in a group",
        group: "edit",
        keys: ["Ctrl+G"],
        whyNot: needsMovable(1),
        run: onDocument((document, ids) => wrap(document, ids, "group")),
    }),
    row({
        id: "node.dissolve",
        words: "ungroup flatten",
        title: "Dissolve, keep the children",
        group: "edit",
        keys: ["Ctrl+Shift+G"],
        whyNot: canDissolve,
        run: onDocument((document, ids, schema) => dissolve(document, schema, ids[0] ?? "")),
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
            words: "boolean csg combine merge subtract cut add intersect blend",
            group: "edit",
            keys: [key],
            whyNot: needsMovable(2),
            run: onDocument((document, ids) => wrap(document, ids, type)),
        }),
    ),
    row({
        id: "node.wrap",
        words: "modify modifier boolean array mirror twist",
        title: "Wrap in …",
        group: "edit",
        keys: ["W"],
        whyNot: needsMovable(1),
        run: show({ popup: "wrap" }),
    }),
    row({
        id: "model.make",
        words: "component symbol prefab reuse",
        title: "Make a model of it",
        group: "edit",
        keys: ["Ctrl+Alt+K"],
        whyNot: needsMovable(1),
        run: onDocument((document, ids, schema) => makeModel(document, schema, ids)),
    }),
    row({
        id: "primitive.make",
        words: "parameters custom own shape component prefab node asset",
        title: "Make a primitive of it …",
        group: "edit",
        whyNot: needsPart,
        run: show({ popup: "primitive", model: null }),
    }),
    row({
        id: "model.parameters",
        words: "numbers expose settings primitive",
        title: "Choose its parameters …",
        group: "edit",
        whyNot: needsInstance,
        run: show({ popup: "primitive", model: null }),
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
        id: "library.save",
        words: "store keep reuse preset primitive collection asset",
        title: "Save to My library",
        group: "edit",
        whyNot: needsOne,
        run: (app) => app.saveToLibrary(selectionOf(app)[0] ?? ""),
    }),
    row({
        id: "library.open",
        words: "collection presets reuse assets primitives materials models import export",
        title: "My library",
        group: "scene",
        whyNot: never,
        run: show({ popup: "library" }),
    }),
    row({
        id: "node.up",
        words: "order move earlier",
        title: "Move up among its siblings",
        group: "edit",
        keys: ["Alt+Up"],
        whyNot: canReorder(-1),
        run: onDocument((document, ids) => reorder(document, ids[0] ?? "", -1)),
    }),
    row({
        id: "node.down",
        words: "order move later",
        title: "Move down among its siblings",
        group: "edit",
        keys: ["Alt+Down"],
        whyNot: canReorder(1),
        run: onDocument((document, ids) => reorder(document, ids[0] ?? "", 1)),
    }),
    row({
        id: "node.park",
        words: "shelf aside disconnect unplug wire store",
        title: "Put on the shelf",
        group: "edit",
        whyNot: canPark,
        run: onDocument(park),
    }),
    row({
        id: "node.unpark",
        words: "shelf back connect",
        title: "Take off the shelf",
        group: "edit",
        whyNot: canUnpark,
        run: onDocument(unpark),
    }),
    row({
        id: "node.hide",
        words: "visibility mute eye",
        title: "Hide or show",
        group: "edit",
        keys: ["H", "M"],
        whyNot: needsSelection,
        run: hideNodes,
    }),
    row({
        id: "node.isolate",
        words: "solo alone hide others",
        title: "Isolate, or show all again",
        group: "edit",
        keys: ["Shift+H", "/"],
        whyNot: (app) => (isIsolating(app) ? null : needsSelection(app)),
        run: isolate,
    }),
    row({
        id: "node.showAll",
        title: "Show everything",
        group: "edit",
        keys: ["Alt+H"],
        whyNot: (app) => {
            const document = documentOf(app);
            return isIsolating(app) || (document && hiddenNodes(document).length > 0)
                ? null
                : text("why.allVisible");
        },
        run: showAll,
    }),
    row({
        id: "select.all",
        words: "everything",
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
        words: "zoom fit focus look",
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
        words: "zoom fit all reset view",
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
        words: "view store viewpoint",
        title: "Save this camera to the scene",
        group: "camera",
        run: saveCamera,
    }),
    row({
        id: "camera.focus",
        title: "Pick what to focus on",
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
        words: "aov buffer pass debug normals depth",
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
        words: "fullscreen presentation panels zen",
        title: "Hide or show the panels",
        group: "view",
        keys: ["Ctrl+\\"],
        inFields: true,
        whyNot: never,
        run: show(({ chromeHidden }) => ({ chromeHidden: !chromeHidden })),
    }),
    row({
        id: "view.graph",
        words: "node graph wires network flow cards drawer",
        title: "Graph of nodes",
        group: "view",
        keys: ["Alt+1"],
        inFields: true,
        run: show(toggleDrawer("graph")),
    }),
    row({
        id: "view.text",
        words: "json source code document edit raw drawer",
        title: "Scene as text",
        group: "view",
        keys: ["Alt+2"],
        inFields: true,
        run: show(toggleDrawer("text")),
    }),
    row({
        id: "view.grid",
        words: "floor ground plane lines axes raster show hide",
        title: "Ground grid in the picture",
        group: "view",
        whyNot: never,
        run: toggle("grid"),
    }),
    row({
        id: "view.marks",
        words: "icons overlay gizmos show hide",
        title: "Lights, volumes and camera in the picture",
        group: "view",
        whyNot: never,
        run: toggle("marks"),
    }),
    row({
        id: "view.measure",
        words: "ruler distance length size dimension tape",
        title: "Measure distances",
        group: "view",
        whyNot: never,
        run: show(({ measured }) => ({ measured: measured === null ? [] : null })),
    }),
    row({
        id: "view.section",
        words: "cut plane clip slice inside cross clipping",
        title: "Section: cut the picture by a plane",
        group: "view",
        keys: ["K"],
        whyNot: never,
        run: toggleSection,
    }),
    row({
        id: "view.outlines",
        words: "contour edges highlight selection hover show hide",
        title: "Outlines in the picture",
        group: "view",
        whyNot: never,
        run: toggle("outlines"),
    }),
    row({
        id: "view.probe",
        words: "value colour depth distance position coordinates pointer pick inspect",
        title: "Tell what is under the pointer",
        group: "view",
        whyNot: never,
        run: toggle("probe"),
    }),
    row({
        id: "view.statistics",
        words: "performance fps speed timing",
        title: "Statistics",
        group: "view",
        run: show({ popup: "statistics" }),
    }),
    row({
        id: "view.thumbnails",
        words: "preview icons tiles tree",
        title: "Thumbnails in the tree",
        group: "view",
        whyNot: never,
        run: toggle("thumbnails"),
    }),
    row({
        id: "view.trackpad",
        words: "touchpad mouse wheel scroll pinch zoom input device",
        title: "Trackpad: two fingers orbit, or zoom",
        group: "view",
        whyNot: never,
        run: ({ stores: { view } }) =>
            setPreferences(view, {
                pointing:
                    view.getState().preferences.pointing === "trackpad" ? "mouse" : "trackpad",
            }),
    }),
    row({
        id: "view.theme",
        words: "next dark light system mode appearance",
        title: "Switch the theme",
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
        words: "load file example start home",
        title: "Scenes",
        group: "scene",
        keys: ["Ctrl+O"],
        whyNot: never,
        run: show({ popup: "scenes" }),
    }),
    row({
        id: "scene.save",
        words: "store sync",
        title: "Is it saved?",
        group: "scene",
        keys: ["Ctrl+S"],
        inFields: true,
        run: saved,
    }),
    row({
        id: "scene.download",
        words: "export file backup json",
        title: "Download as JSON",
        group: "scene",
        run: (app) => app.download(),
    }),
    row({
        id: "scene.picture",
        words: "export render image screenshot png jpg save",
        title: "Download a picture …",
        group: "scene",
        keys: ["Ctrl+Shift+S"],
        inFields: true,
        run: show({ popup: "picture" }),
    }),
    row({
        id: "scene.upload",
        words: "import load insert open json environment hdri panorama picture backdrop",
        title: "Open or insert files …",
        group: "scene",
        whyNot: never,
        run: (app) => app.upload(),
    }),
    row({
        id: "scene.folder",
        words: "import load directory thesis files",
        title: "Import a folder …",
        group: "scene",
        whyNot: never,
        run: (app) => app.upload(true),
    }),
    row({
        id: "help.groebner",
        words: "algebra buchberger ideal polynomial elimination workbench grobner gröbner",
        title: "Groebner bases …",
        group: "help",
        whyNot: never,
        run: show({ popup: "groebner" }),
    }),
    row({
        id: "help.reference",
        words: "documentation manual docs types",
        title: "Reference of all types",
        group: "help",
        keys: ["F1"],
        whyNot: never,
        run: ({ stores }) => stores.view.setState({ popup: "reference", topic: topicOf(stores) }),
    }),
    row({
        id: "help.keys",
        words: "shortcuts gestures keyboard cheat sheet",
        title: "Keys and gestures",
        group: "help",
        keys: ["?"],
        whyNot: never,
        run: show({ popup: "help" }),
    }),
    row({
        id: "help.singleKeys",
        words: "shortcuts letters accessibility speech disable",
        title: "Single keys act as commands, or do not",
        group: "help",
        whyNot: never,
        run: toggle("singleKeys"),
    }),
];
