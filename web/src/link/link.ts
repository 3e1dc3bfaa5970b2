/* SPDX-License-Identifier: MIT */
/* The page's side of a live scene: connects, edits, picks, shows. Keeps the stores up to date.
 * Socket, decoding and presentation run in a worker where the browser allows it. */
import type { Box } from "../model/camera.ts";
import { paramAt } from "../model/document.ts";
import {
    EMPTY_HISTORY,
    fitHistory,
    forgetStep,
    nameSteps,
    recordRedo,
    recordStep,
    recordUndo,
} from "../model/history.ts";
import type { Operation, Problem } from "../model/operation.ts";
import { nodeOfPlace } from "../model/places.ts";
import { dropGone, settleProblems } from "../model/problems.ts";
import type { Schema, Value } from "../model/schema.ts";
import * as sessions from "../model/session.ts";
import { EMPTY_DOCUMENT_STATE, IDLE_LINK, type LinkState, type Stores } from "../model/stores.ts";
import { text } from "../model/texts.ts";
import { vectorOf } from "../model/transform.ts";
import { checkValue } from "../model/values.ts";
import { selectAfter } from "../model/view.ts";
import { type Author, randomId } from "./author.ts";
import type { Report } from "./engine.ts";
import { type Host, startHost } from "./host.ts";
import { Motion } from "./motion.ts";
import { Notices } from "./notices.ts";
import {
    type BoundedMessage,
    type CompilingMessage,
    type PickedMessage,
    type ServerMessage,
    SUBPROTOCOL,
    TOKEN_PREFIX,
} from "./protocol.ts";
import { Questions } from "./questions.ts";
import { ThumbnailStore, type Thumbnails } from "./thumbnails.ts";
import { Viewer } from "./viewer.ts";

export interface EditOptions {
    /* Edits of one group are one undo step. */
    readonly group?: string;
    /* What the undo entry is called: "move head". */
    readonly label?: string;
}

/* One drag, one undo step: shown at once, sent at most once per animation frame. */
export interface Gesture {
    readonly group: string;
    /* False where the edit cannot be; the reason is in the notices. */
    edit(ops: readonly Operation[]): boolean;
    end(): void;
    /* Takes back everything that the gesture did. */
    cancel(): void;
}

export interface Link {
    /* Opens a scene as an author; closes the one before. Needs the schema to know what may be set. */
    connect(scene: string, schema: Schema, author: Author): void;
    disconnect(): void;
    /* Shows the picture in `element`, filling it; answers the function that takes it away. */
    attach(element: HTMLElement): () => void;
    /* Shows and sends an edit. False where it cannot be; the reason is in the notices. */
    edit(ops: readonly Operation[], options?: EditOptions): boolean;
    gesture(label: string): Gesture;
    undo(): void;
    redo(): void;
    /* What lies under a point of the picture, in CSS pixels from its left top. */
    pick(x: number, y: number, through?: boolean): Promise<PickedMessage>;
    /* The same, but not while another answer is due, which it would take the place of: null. */
    pickIdle(x: number, y: number): Promise<PickedMessage | null>;
    /* A box around what is to be seen of nodes, in the world; of all without ids. Null: nothing is,
     * it has no end, or the scene is not live. */
    bounds(nodes: readonly string[]): Promise<Box | null>;
    /* What was given up at a place, because it was too slow or crashed, is tried again. */
    tryAgain(place: string): void;
    /* Small pictures of nodes and materials. */
    readonly thumbnails: Thumbnails;
    /* Tries to connect at once instead of waiting for the next attempt. */
    retry(): void;
    destroy(): void;
}

export interface LinkOptions {
    /* Address of the server, such as "http://127.0.0.1:8080"; "" is the page's own. */
    readonly base: string;
    readonly token: string | null;
    /* Shown to others. */
    readonly name?: string;
}

/* Of an undo or redo: the nodes that it has brought back, and what was selected before the step. */
interface Turn {
    readonly back: readonly string[];
    readonly before: readonly string[];
}

class SceneLink implements Link {
    readonly #stores: Stores;
    readonly #options: LinkOptions;
    readonly #host: Host;
    /* Groups of edits are this page's, not those of the author's page before. */
    readonly #page = randomId();
    readonly #viewer: Viewer;
    readonly #picks = new Questions<PickedMessage>();
    readonly #bounds = new Questions<BoundedMessage>();
    readonly #notices: Notices;
    readonly #motion: Motion;
    readonly thumbnails: ThumbnailStore;
    readonly #retry = (): void => this.retry();
    #session: sessions.Session | null = null;
    #author: Author | null = null;
    #groups = 0;
    /* The undo or redo that has just arrived. */
    #turned: Turn | null = null;
    #flushDue = false;

    constructor(stores: Stores, options: LinkOptions) {
        this.#stores = stores;
        this.#options = options;
        this.#host = startHost((report) => this.#take(report));
        this.#viewer = new Viewer(stores, this.#host, () => this.#session !== null);
        this.#notices = new Notices(stores);
        this.#motion = new Motion(stores);
        this.thumbnails = new ThumbnailStore(
            (order) => this.#host.send(order),
            window.devicePixelRatio,
        );
        window.addEventListener("online", this.#retry);
    }

    /* --- connection --- */

    connect(scene: string, schema: Schema, author: Author): void {
        this.disconnect();
        this.#author = author;
        const base = new URL(this.#options.base || window.location.origin);
        const url = new URL(`/v1/scenes/${encodeURIComponent(scene)}/live`, base);
        url.protocol = base.protocol === "https:" ? "wss:" : "ws:";
        const { token, name = "" } = this.#options;
        this.#session = sessions.createSession(schema);
        this.#stores.document.setState({ ...EMPTY_DOCUMENT_STATE, scene, schema });
        this.#stores.link.setState({ ...IDLE_LINK, connection: "connecting" });
        this.#host.send({
            kind: "open",
            url: url.href,
            protocols: [SUBPROTOCOL, ...(token === null ? [] : [TOKEN_PREFIX + token])],
            client: author.id,
            key: author.key,
            name,
        });
        this.#viewer.tell();
    }

    disconnect(): void {
        if (this.#session) {
            this.#flush();
        }
        this.#session = null;
        this.#failQuestions();
        this.thumbnails.clear();
        this.#host.send({ kind: "close" });
        const { schema } = this.#stores.document.getState();
        this.#stores.document.setState({ ...EMPTY_DOCUMENT_STATE, schema });
        this.#stores.link.setState(IDLE_LINK);
        this.#stores.camera.setState({ own: false });
    }

    tryAgain(place: string): void {
        this.#host.send({ kind: "send", message: { type: "retry", place } });
    }

    retry(): void {
        this.#host.send({ kind: "retry" });
    }

    destroy(): void {
        this.disconnect();
        this.#viewer.end();
        this.#motion.end();
        window.removeEventListener("online", this.#retry);
        this.#host.end();
    }

    #take(report: Report): void {
        if (!this.#session) {
            return;
        }
        switch (report.kind) {
            case "state":
                this.#connection(report);
                break;
            case "message":
                this.#message(report.message);
                break;
            case "frame":
                this.#stores.link.setState({ frame: report.frame });
                break;
            case "guide":
                this.#stores.link.setState({ guide: report.guide });
                break;
            case "thumbnails":
                this.thumbnails.take(report.tiles);
                break;
            case "statistics":
                this.#stores.link.setState({ statistics: report.statistics });
                break;
        }
    }

    #connection(report: Extract<Report, { kind: "state" }>): void {
        const { state, reason, retryIn, attempts } = report;
        const next: Partial<LinkState> = {
            connection: state,
            reason,
            retryAt: retryIn === null ? null : performance.now() + retryIn,
            ...(state === "live" ? {} : { compiling: null }),
        };
        this.#stores.link.setState(next);
        if (this.#session && (state === "offline" || state === "refused")) {
            this.#session = sessions.disconnect(this.#session);
            this.#failQuestions();
        }
        const never = this.#session?.confirmed === null;
        if (state === "offline" && (never || attempts >= ATTEMPTS_BEFORE_PROBE)) {
            void this.#probe();
        }
    }

    /* A WebSocket that fails does not say why; the document's address does. */
    async #probe(): Promise<void> {
        const { scene } = this.#stores.document.getState();
        const { base, token } = this.#options;
        const headers: HeadersInit = token === null ? {} : { Authorization: `Bearer ${token}` };
        const url = `${base}/v1/scenes/${encodeURIComponent(scene ?? "")}`;
        const response = await fetch(url, { headers }).catch(() => null);
        const left = this.#stores.document.getState().scene !== scene;
        if (!left && response && FINAL_STATUS.includes(response.status)) {
            const reason = `${response.status} ${response.statusText}`.trim();
            this.#host.send({ kind: "close" });
            this.#stores.link.setState({ connection: "refused", reason, retryAt: null });
        }
    }

    /* --- messages --- */

    #message(message: ServerMessage): void {
        switch (message.type) {
            case "picked":
                this.#picks.answer(message.pick, message);
                break;
            case "bounded":
                this.#bounds.answer(message.bounds, message);
                break;
            case "compiling":
                this.#compiling(message);
                break;
            case "notice":
                if (message.code === "forbidden" && message.place === "/key") {
                    this.#becomeAnother();
                } else {
                    this.#notices.fromServer(message);
                }
                break;
            case "bye":
                break;
            case "welcome":
                this.#author?.keep(message.key);
                this.#stores.link.setState({ renderer: message.renderer });
                this.#notices.welcome();
                this.#receive(message);
                this.#nameSteps(message.undo_labels ?? [], message.redo_labels ?? []);
                break;
            default:
                this.#receive(message);
        }
    }

    /* The key is lost, or the id was taken: what its author did stays, and cannot be undone here. */
    #becomeAnother(): void {
        const { scene } = this.#stores.document.getState();
        if (scene !== null && this.#author && this.#session) {
            const { schema } = this.#session;
            this.#author.renew();
            this.connect(scene, schema, this.#author);
        }
    }

    #compiling({ over, elapsed_ms, expected_ms }: CompilingMessage): void {
        const since = performance.now() - elapsed_ms;
        const compiling = over ? null : { since, expected: expected_ms ?? null };
        this.#stores.link.setState({ compiling });
    }

    #receive(message: sessions.SessionMessage): void {
        if (!this.#session) {
            return;
        }
        const { shown } = this.#session;
        const heldBack = sessions.isHeldBack(this.#session);
        const { session, events } = sessions.receive(this.#session, message);
        this.#session = session;
        if (shown && session.shown && isOfOthers(events)) {
            this.#notices.lost(shown, session.shown);
        }
        for (const event of events) {
            this.#event(event);
        }
        const { revision, epoch, confirmed, fits } = session;
        if (fits && epoch !== null && confirmed !== null) {
            this.#host.send({ kind: "at", revision, epoch });
        }
        if (message.type === "welcome" || (heldBack && !sessions.isHeldBack(session))) {
            this.#flush();
        }
        this.#publish();
        this.#selectTurned();
    }

    #selectTurned(): void {
        const { document } = this.#stores.document.getState();
        const { selection } = this.#stores.view.getState();
        if (this.#turned && document) {
            const { back, before } = this.#turned;
            const next = selectAfter(document, selection, back, before);
            if (next !== selection) {
                this.#stores.view.setState({ selection: next, subject: { kind: "nodes" } });
            }
        }
        this.#turned = null;
    }

    /* Steps of the author's page before. */
    #nameSteps(undo: readonly string[], redo: readonly string[]): void {
        if (this.#session?.pending.length === 0) {
            this.#stores.document.setState(({ history }) => ({
                history: nameSteps(history, undo, redo),
            }));
        }
    }

    #event(event: sessions.SessionEvent): void {
        switch (event.kind) {
            case "rejected":
                if (!event.cancelled) {
                    this.#notices.rejected(event.pending, event.problem);
                }
                this.#forgetRefused(event.pending);
                break;
            case "skipped":
                this.#notices.skipped(event.ops);
                break;
            case "done":
                this.#turned = this.#turnOf(event.pending, event.ops ?? []);
                this.#done(event.pending);
                break;
            case "resync":
                this.#notices.add("warning", "resync", text("link.resync"));
                this.#host.send({ kind: "resync" });
                break;
            default:
                break;
        }
    }

    #turnOf({ kind }: sessions.PendingEdit, ops: readonly Operation[]): Turn | null {
        const { undo } = this.#stores.document.getState().history;
        return kind === "edit"
            ? null
            : {
                  back: insertedNodes(ops),
                  before: kind === "undo" ? (undo.at(-1)?.selection ?? []) : [],
              };
    }

    #done({ kind, ops }: sessions.PendingEdit): void {
        this.#stores.document.setState(({ history, problems }) => ({
            problems: settleProblems(problems, ops),
            history:
                kind === "undo"
                    ? recordUndo(history)
                    : kind === "redo"
                      ? recordRedo(history)
                      : history,
        }));
    }

    /* --- edits --- */

    edit(ops: readonly Operation[], options: EditOptions = {}): boolean {
        const session = this.#session;
        if (!session || ops.length === 0) {
            return false;
        }
        const refused = checkRanges(session, ops);
        const result = refused ? null : sessions.edit(session, ops, options);
        const problem = refused ?? result?.problem ?? null;
        if (problem || !result) {
            const message = text("edit.refused", { message: problem?.message ?? "" });
            this.#notices.add("warning", problem?.code ?? "", message, problem?.place);
            return false;
        }
        this.#session = result.session;
        const { group = "", label = "" } = options;
        const { selection } = this.#stores.view.getState();
        this.#stores.document.setState(({ history }) => ({
            history: recordStep(history, { group, label, selection }),
        }));
        this.#publish();
        if (group === "") {
            this.#flush();
        } else {
            this.#motion.touch();
            this.#flushSoon();
        }
        return true;
    }

    gesture(label: string): Gesture {
        this.#groups++;
        const group = `${this.#page}-${this.#groups}`;
        let edited = false;
        let open = true;
        return {
            group,
            edit: (ops) => {
                const done = open && this.edit(ops, { group, label });
                edited ||= done;
                return done;
            },
            end: () => {
                open = false;
                this.#flush();
            },
            cancel: () => {
                if (open && edited) {
                    this.#cancel(group);
                }
                open = false;
            },
        };
    }

    #cancel(group: string): void {
        if (this.#session) {
            this.#forgetStep(group);
            this.#session = sessions.cancelGroup(this.#session, group);
            this.#flush();
            this.#publish();
        }
    }

    #forgetRefused(pending: sessions.PendingEdit | null): void {
        if (pending?.kind === "edit" && pending.group !== "") {
            this.#forgetStep(pending.group);
        }
    }

    /* Unless the server has it, or will have: then an undo takes it away. */
    #forgetStep(group: string): void {
        if (this.#session && !sessions.isStep(this.#session, group)) {
            this.#stores.document.setState(({ history }) => ({
                history: forgetStep(history, group),
            }));
        }
    }

    undo(): void {
        this.#history("undo");
    }

    redo(): void {
        this.#history("redo");
    }

    #history(kind: "undo" | "redo"): void {
        if (this.#session) {
            this.#session = sessions.askHistory(this.#session, kind);
            this.#flush();
            this.#publish();
        }
    }

    #flushSoon(): void {
        if (!this.#flushDue) {
            this.#flushDue = true;
            const run = (): void => {
                if (this.#flushDue) {
                    this.#flush();
                }
            };
            requestAnimationFrame(run);
            setTimeout(run, LATEST_FLUSH_MS);
        }
    }

    #flush(): void {
        this.#flushDue = false;
        if (this.#session) {
            const { session, messages } = sessions.takeOutbox(this.#session);
            this.#session = session;
            for (const message of messages) {
                this.#host.send({ kind: "send", message });
            }
        }
    }

    #publish(): void {
        const session = this.#session;
        if (!session) {
            return;
        }
        const before = this.#stores.document.getState();
        const settled = session.pending.length === 0;
        this.#stores.document.setState({
            document: session.shown,
            revision: session.revision,
            waiting: sessions.waiting(session),
            saved: sessions.isSaved(session),
            ...sessions.stepsAhead(session),
            problems: dropGone(before.problems, session.shown),
            history: settled
                ? fitHistory(before.history ?? EMPTY_HISTORY, session.undo, session.redo)
                : before.history,
        });
        this.#notices.dropGone();
        if (session.shown && session.shown.camera !== before.document?.camera) {
            this.#viewer.followCamera();
        }
    }

    /* --- view --- */

    attach(element: HTMLElement): () => void {
        return this.#viewer.attach(element);
    }

    pick(x: number, y: number, through = false): Promise<PickedMessage> {
        const pixel = this.#viewer.pixelAt(x, y);
        if (!pixel || this.#stores.link.getState().connection !== "live") {
            return Promise.reject(new Error("not connected"));
        }
        return this.#picks.ask((number) =>
            this.#host.send({ kind: "pick", pick: number, ...pixel, through }),
        );
    }

    pickIdle(x: number, y: number): Promise<PickedMessage | null> {
        return this.#picks.waiting ? Promise.resolve(null) : this.pick(x, y);
    }

    async bounds(nodes: readonly string[]): Promise<Box | null> {
        if (this.#stores.link.getState().connection !== "live") {
            return null;
        }
        this.#flush();
        const { low, high } = await this.#bounds.ask((bounds) =>
            this.#host.send({ kind: "send", message: { type: "bounds", bounds, nodes } }),
        );
        return low && high ? { low: vectorOf(low), high: vectorOf(high) } : null;
    }

    #failQuestions(): void {
        this.#picks.fail();
        this.#bounds.fail();
    }
}

/* Failed attempts after which the reason is looked for; at once where the scene was never there. */
const ATTEMPTS_BEFORE_PROBE = 2;
/* Answers that waiting will not change. */
const FINAL_STATUS: readonly number[] = [400, 401, 403, 404];
/* Hidden pages get no animation frames. */
const LATEST_FLUSH_MS = 50;

/* Did somebody else change the document, or is it read anew? */
function isOfOthers(events: readonly sessions.SessionEvent[]): boolean {
    const kinds = events.map(({ kind }) => kind);
    return kinds.includes("reset") || (kinds.includes("changed") && !kinds.includes("done"));
}

/* The nodes that operations put into trees. */
function insertedNodes(ops: readonly Operation[]): string[] {
    return ops.flatMap((op) =>
        op.op === "insert" && nodeOfPlace(op.into) !== null && typeof op.value.id === "string"
            ? [op.value.id]
            : [],
    );
}

/* Values that the schema refuses, before anybody sees them. */
function checkRanges(session: sessions.Session, ops: readonly Operation[]): Problem | null {
    for (const op of ops) {
        if (op.op !== "set" || op.value === null || !session.shown) {
            continue;
        }
        const found = paramAt(session.schema, session.shown, op.at);
        const message = found && checkValue(found.param, op.value as Value);
        if (message) {
            return { code: "invalid", place: op.at, message };
        }
    }
    return null;
}

export function createLink(stores: Stores, options: LinkOptions): Link {
    return new SceneLink(stores, options);
}
