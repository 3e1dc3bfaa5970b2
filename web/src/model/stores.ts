/* SPDX-License-Identifier: MIT */
/* The stores that the page reads: document, view, link, notices, and the camera, which changes too
 * often for React. Plain Zustand; the link and the commands write them, `ui` subscribes. */
import { createStore, type StoreApi } from "zustand/vanilla";
import type { Camera } from "./camera.ts";
import { DEFAULT_CAMERA } from "./camera.ts";
import type { SceneDocument } from "./document.ts";
import type { Guide } from "./guide.ts";
import { EMPTY_HISTORY, type History } from "./history.ts";
import type { EntryRow } from "./libraryEntries.ts";
import type { Operation } from "./operation.ts";
import { NO_PROBLEMS, type Problems } from "./problems.ts";
import { EMPTY_SCHEMA, type Schema } from "./schema.ts";
import { INITIAL_VIEW, type Preferences, readPreferences, type View } from "./view.ts";

/* --- document: what is shown, confirmed plus pending --- */

export interface DocumentState {
    readonly scene: string | null;
    readonly schema: Schema;
    readonly document: SceneDocument | null;
    readonly revision: number;
    /* Edits made here that the server does not hold yet. */
    readonly waiting: number;
    /* Everything of ours is durable. */
    readonly saved: boolean;
    readonly canUndo: boolean;
    readonly canRedo: boolean;
    readonly history: History;
    readonly problems: Problems;
}

export const EMPTY_DOCUMENT_STATE: DocumentState = {
    scene: null,
    schema: EMPTY_SCHEMA,
    document: null,
    revision: 0,
    waiting: 0,
    saved: true,
    canUndo: false,
    canRedo: false,
    history: EMPTY_HISTORY,
    problems: NO_PROBLEMS,
};

/* --- link: the connection and the picture --- */

export type Connection =
    | "idle" /* no scene open */
    | "connecting"
    | "live"
    | "offline" /* lost; tries again by itself */
    | "refused"; /* told not to come back */

export type FrameState = "none" | "moving" | "still" | "lossless";

export interface RendererInfo {
    readonly name: string;
    readonly version: string;
    readonly software: boolean;
    /* What computes pictures. */
    readonly stage: "engine" | "compute" | "fragment";
    readonly device: string;
}

/* Of the frame on screen. */
export interface FrameInfo {
    readonly state: FrameState;
    /* The scene is newer than the picture: its shader is being compiled. */
    readonly stale: boolean;
    /* The view is newer than the picture: another camera, output, size, or other nodes alone. */
    readonly outdated: boolean;
    readonly number: number;
    /* `seq` of the view that it shows. */
    readonly input: number;
    readonly revision: number;
    readonly width: number;
    readonly height: number;
    /* Picture width over view width, 1 = every device pixel. */
    readonly scale: number;
    /* Which round of samples it is, from 1, and how many there are. */
    readonly round: number;
    readonly rounds: number;
    /* That it was drawn with; null: the document's. */
    readonly camera: Camera | null;
}

/* The server makes the newest state ready to be drawn. */
export interface Compiling {
    /* When it began, by performance.now(). */
    readonly since: number;
    /* Milliseconds that scenes of that size took; null: not known. */
    readonly expected: number | null;
}

/* Rates over the last second; milliseconds and bytes of the last frames of the newest one's kind,
 * the newest counting most. What was not measured is null. */
export interface Statistics {
    readonly fps: number;
    readonly state: FrameState;
    /* In the order of the schema's stages. */
    readonly stages: readonly number[];
    /* First byte of a frame here until its last. */
    readonly receive: number;
    readonly decode: number;
    readonly present: number;
    /* From sending a view to showing the first frame with it. */
    readonly photonP50: number | null;
    readonly photonP95: number | null;
    readonly bytesPerFrame: number;
    readonly bytesPerSecond: number;
    readonly dropped: number;
}

export interface LinkState {
    readonly connection: Connection;
    /* Why the connection was refused or lost, for people. */
    readonly reason: string;
    /* When the next attempt is made, by performance.now(); null: none planned. */
    readonly retryAt: number | null;
    readonly renderer: RendererInfo | null;
    readonly frame: FrameInfo;
    /* Of the newest picture that has one; guide.ts says whether that is shown. */
    readonly guide: Guide | null;
    readonly compiling: Compiling | null;
    /* A hand moves the camera or a value. */
    readonly moving: boolean;
    readonly statistics: Statistics | null;
}

/* There is no such scene, or no longer. */
export const isGone = ({ connection, reason }: LinkState): boolean =>
    connection === "refused" && /^(404|deleted|not_found)/.test(reason);

export const NO_FRAME: FrameInfo = {
    state: "none",
    stale: false,
    outdated: false,
    number: 0,
    input: 0,
    revision: 0,
    width: 0,
    height: 0,
    scale: 1,
    round: 0,
    rounds: 1,
    camera: null,
};

export const IDLE_LINK: LinkState = {
    connection: "idle",
    reason: "",
    retryAt: null,
    renderer: null,
    frame: NO_FRAME,
    guide: null,
    compiling: null,
    moving: false,
    statistics: null,
};

/* --- notices --- */

export type Level = "info" | "warning" | "error";

export interface Notice {
    readonly id: number;
    readonly level: Level;
    readonly code: string;
    readonly message: string;
    readonly place: string;
    /* How often it came in a row. */
    readonly count: number;
    /* What may be done about it, each a button. */
    readonly acts: readonly NoticeAct[];
}

export type NoticeAct =
    /* Takes the newest step back, as long as it is the one of that label. */
    | { readonly kind: "undo"; readonly label: string }
    /* Does all the same what was left out. */
    | { readonly kind: "edit"; readonly label: string; readonly ops: readonly Operation[] }
    /* What was given up there is tried again; `slow`: with more time. */
    | { readonly kind: "retry"; readonly place: string; readonly slow: boolean }
    /* Takes back what is no edit of the scene. */
    | { readonly kind: "back"; readonly run: () => void }
    /* Two fingers on a trackpad orbit from now on. */
    | { readonly kind: "orbit"; readonly run: () => void };

export interface NoticeState {
    readonly notices: readonly Notice[];
}

const NOTICES_KEPT = 50;

/* Adds a notice; one like the newest only counts up. Of what is wrong at a place the newest stays. */
export function addNotice(
    notices: StoreApi<NoticeState>,
    notice: Pick<Notice, "level" | "code" | "message"> & Partial<Pick<Notice, "place" | "acts">>,
): void {
    notices.setState(({ notices: old }) => {
        const { level, code, message, place = "", acts = [] } = notice;
        const last = old.at(-1);
        if (last && last.code === code && last.message === message && last.place === place) {
            return { notices: [...old.slice(0, -1), { ...last, acts, count: last.count + 1 }] };
        }
        const others =
            level === "error" && place !== ""
                ? old.filter((one) => one.level !== "error" || one.place !== place)
                : old;
        const added = { id: (last?.id ?? 0) + 1, level, code, message, place, count: 1, acts };
        return { notices: [...others, added].slice(-NOTICES_KEPT) };
    });
}

/* Takes away what is over. */
export function endNotices(
    notices: StoreApi<NoticeState>,
    isOver: (notice: Notice) => boolean,
): void {
    if (notices.getState().notices.some(isOver)) {
        notices.setState(({ notices: old }) => ({ notices: old.filter((one) => !isOver(one)) }));
    }
}

export function dismissNotice(notices: StoreApi<NoticeState>, id: number): void {
    notices.setState(({ notices: old }) => ({ notices: old.filter((one) => one.id !== id) }));
}

/* --- camera --- */

export interface CameraState {
    readonly camera: Camera;
    /* False until the user moves: the document's own camera is followed. */
    readonly own: boolean;
    /* The document's. */
    readonly saved: Camera;
}

/* --- the library --- */

export interface LibraryState {
    /* By name; null: not read yet. */
    readonly entries: readonly EntryRow[] | null;
}

/* --- all of them --- */

export interface Stores {
    readonly document: StoreApi<DocumentState>;
    readonly view: StoreApi<View>;
    readonly link: StoreApi<LinkState>;
    readonly notices: StoreApi<NoticeState>;
    readonly camera: StoreApi<CameraState>;
    readonly library: StoreApi<LibraryState>;
}

/* Where preferences live; the browser's localStorage fits. */
export interface Storage {
    getItem(key: string): string | null;
    setItem(key: string, value: string): void;
}

const PREFERENCES_KEY = "fieldcast.preferences";

export function createStores(storage: Storage | null): Stores {
    const preferences = readPreferences(storage?.getItem(PREFERENCES_KEY) ?? null);
    const view = createStore<View>(() => ({ ...INITIAL_VIEW, preferences }));
    view.subscribe((now, before) => {
        if (now.preferences !== before.preferences) {
            storage?.setItem(PREFERENCES_KEY, JSON.stringify(now.preferences));
        }
    });
    return {
        document: createStore<DocumentState>(() => EMPTY_DOCUMENT_STATE),
        view,
        link: createStore<LinkState>(() => IDLE_LINK),
        notices: createStore<NoticeState>(() => ({ notices: [] })),
        camera: createStore<CameraState>(() => ({
            camera: DEFAULT_CAMERA,
            own: false,
            saved: DEFAULT_CAMERA,
        })),
        library: createStore<LibraryState>(() => ({ entries: null })),
    };
}

export function setPreferences(view: StoreApi<View>, part: Partial<Preferences>): void {
    view.setState(({ preferences }) => ({ preferences: { ...preferences, ...part } }));
}
