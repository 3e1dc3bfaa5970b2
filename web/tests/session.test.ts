/* SPDX-License-Identifier: MIT */
/* Three clients and a model of the server with random delays, refusals, lost connections and
 * restarts: all end with the server's document, and nothing acknowledged is lost. */
import { expect, test } from "vitest";
import type { SceneDocument } from "../src/model/document.ts";
import { printDocument, readDocument } from "../src/model/documentJson.ts";
import { equalJson, type Json } from "../src/model/json.ts";
import type { Operation } from "../src/model/operation.ts";
import { apply } from "../src/model/operations.ts";
import {
    askHistory,
    cancelGroup,
    createSession,
    disconnect,
    edit,
    isHeldBack,
    isSaved,
    type OutgoingEdit,
    receive,
    type Session,
    type SessionEvent,
    type SessionMessage,
    stepsAhead,
    takeOutbox,
    waiting,
} from "../src/model/session.ts";
import { choose, random, randomOperation, SCENE, SCHEMA } from "./fixture.ts";

interface Entry {
    readonly author: string;
    readonly edit: number;
    readonly ops: readonly Operation[];
    readonly inverse: readonly Operation[];
}

/* The server as protocol/README.md describes it. */
class Server {
    log: Entry[] = [];
    durable = 0;
    epoch = 1;
    undoOf = new Map<string, Operation[][]>();
    readonly clients = new Map<string, Client>();
    refuse: () => boolean = () => false;

    document(revision = this.log.length): SceneDocument {
        let document = readDocument(SCENE);
        for (const { ops } of this.log.slice(0, revision)) {
            const result = apply(document, ops, SCHEMA);
            if (!result.ok) {
                throw new Error("the log does not replay");
            }
            document = result.document;
        }
        return document;
    }

    lastEdit(author: string): number {
        return Math.max(0, ...this.log.filter((e) => e.author === author).map((e) => e.edit));
    }

    hello(client: Client, revision: number, epoch: number | null): void {
        this.clients.set(client.name, client);
        client.hear({
            type: "welcome",
            revision: this.log.length,
            epoch: this.epoch,
            last_edit: this.lastEdit(client.name),
        });
        if (epoch !== this.epoch || revision > this.log.length || revision === 0) {
            client.hear({
                type: "document",
                revision: this.log.length,
                document: printDocument(this.document()),
            });
            return;
        }
        for (let r = revision; r < this.log.length; r++) {
            const entry = this.log[r] as Entry;
            client.hear({
                type: "changed",
                revision: r + 1,
                author: entry.author,
                ops: entry.ops,
                ...(entry.author === client.name ? { edit: entry.edit } : {}),
            });
        }
    }

    applied(client: Client, number: number, revision: number): void {
        const undo = this.undoOf.get(client.name)?.length ?? 0;
        const durable = revision <= this.durable;
        client.hear({ type: "applied", edit: number, revision, durable, undo, redo: 0 });
    }

    take(client: Client, message: OutgoingEdit): void {
        const known = this.log.findIndex(
            (e) => e.author === client.name && e.edit === message.edit,
        );
        if (known >= 0) {
            this.applied(client, message.edit, known + 1);
            return;
        }
        const steps = this.undoOf.get(client.name) ?? [];
        const ops = message.type === "edit" ? message.ops : steps.at(-1);
        const result = ops && !this.refuse() ? apply(this.document(), ops, SCHEMA) : null;
        if (!result?.ok || !ops) {
            const problem = result?.ok === false ? result.problem : null;
            const { code = "not_found", place = "", message: text = "no" } = problem ?? {};
            client.hear({ type: "rejected", edit: message.edit, code, place, message: text });
            return;
        }
        const { inverse } = result;
        this.log.push({ author: client.name, edit: message.edit, ops, inverse });
        this.undoOf.set(
            client.name,
            message.type === "edit" ? [...steps, [...inverse]] : steps.slice(0, -1),
        );
        const revision = this.log.length;
        for (const other of this.clients.values()) {
            if (other !== client || message.type !== "edit") {
                const own = other === client ? { edit: message.edit } : {};
                other.hear({ type: "changed", revision, author: client.name, ops, ...own });
            }
        }
        this.applied(client, message.edit, revision);
    }

    commit(): void {
        const from = this.durable;
        this.durable = this.log.length;
        this.log.slice(from).forEach(({ author, edit: number }, i) => {
            const client = this.clients.get(author);
            if (client) {
                this.applied(client, number, from + i + 1);
            }
        });
    }

    /* Killed: what was not committed is gone, and so are the connections. */
    crash(): void {
        this.log = this.log.slice(0, this.durable);
        this.epoch++;
        this.undoOf.clear();
        for (const client of [...this.clients.values()]) {
            client.lose();
        }
    }
}

class Client {
    session: Session;
    readonly up: OutgoingEdit[] = [];
    down: SessionMessage[] = [];
    online = false;
    resyncs = 0;
    readonly name: string;
    readonly server: Server;

    constructor(name: string, server: Server) {
        this.name = name;
        this.server = server;
        this.session = createSession(SCHEMA);
    }

    /* The worker's knowledge of the revision may be older than the page's by `lag`. */
    connect(lag = 0): void {
        this.online = true;
        const { confirmed, fits, revision, epoch } = this.session;
        const known = confirmed && fits ? Math.max(0, revision - lag) : 0;
        this.server.hello(this, known, epoch as number | null);
    }

    lose(): void {
        this.online = false;
        this.server.clients.delete(this.name);
        this.up.length = 0;
        this.down = [];
        this.session = disconnect(this.session);
    }

    hear(message: SessionMessage): void {
        this.down.push(JSON.parse(JSON.stringify(message)) as SessionMessage);
    }

    /* The wire delivers one message up, one down. */
    sendOne(): void {
        const message = this.up.shift();
        if (message) {
            this.server.take(this, message);
        }
    }

    takeOne(): void {
        const message = this.down.shift();
        if (!message) {
            return;
        }
        const { session, events } = receive(this.session, message);
        this.session = session;
        this.flush();
        if (events.some(({ kind }) => kind === "resync")) {
            this.resyncs++;
            this.lose();
        }
    }

    flush(): void {
        const { session, messages } = takeOutbox(this.session);
        this.session = session;
        this.up.push(...messages);
    }
}

const text = (document: SceneDocument | null): Json => (document ? printDocument(document) : null);

function settle(server: Server, clients: readonly Client[]): void {
    server.refuse = () => false;
    for (let round = 0; round < 4; round++) {
        for (const client of clients) {
            if (!client.online) {
                client.connect();
            }
            while (client.down.length > 0 || client.up.length > 0) {
                client.takeOne();
                client.sendOne();
            }
        }
        server.commit();
    }
}

function act(client: Client, next: () => number, fresh: () => string): void {
    const { shown } = client.session;
    if (!shown) {
        return;
    }
    const roll = next();
    if (roll < 0.1) {
        client.session = askHistory(client.session, "undo");
    } else {
        const group = roll < 0.5 ? "drag" : "";
        const ops = [randomOperation(shown, next, fresh)];
        client.session = edit(client.session, ops, { group }).session;
    }
    if (next() < 0.7) {
        client.flush();
    }
}

test("three clients converge over delays, refusals, lost connections and restarts", () => {
    let resyncs = 0;
    let revisions = 0;
    for (let seed = 1; seed <= 40; seed++) {
        const next = random(seed);
        let count = 0;
        const fresh = () => `n${count++}`;
        const server = new Server();
        server.refuse = () => next() < 0.05;
        const clients = ["anna", "bert", "carl"].map((name) => new Client(name, server));
        for (let step = 0; step < 250; step++) {
            const client = choose(clients, next);
            const roll = next();
            if (!client.online) {
                client.connect(Math.floor(next() * 3));
            } else if (roll < 0.02) {
                client.lose();
            } else if (roll < 0.023) {
                server.crash();
            } else if (roll < 0.05) {
                server.commit();
            } else if (roll < 0.3) {
                act(client, next, fresh);
            } else if (roll < 0.6) {
                client.sendOne();
            } else {
                client.takeOne();
            }
        }
        settle(server, clients);
        const truth = text(server.document());
        for (const { session, resyncs: own } of clients) {
            expect(equalJson(text(session.confirmed), truth)).toBe(true);
            expect(equalJson(text(session.shown), truth)).toBe(true);
            expect(session.revision).toBe(server.log.length);
            expect(waiting(session)).toBe(0);
            expect(isSaved(session)).toBe(true);
            resyncs += own;
        }
        const once = new Set(server.log.map((e) => `${e.author} ${e.edit}`));
        expect(once.size).toBe(server.log.length);
        revisions += server.log.length;
    }
    expect(revisions).toBeGreaterThan(1000);
    expect(resyncs).toBe(0);
});

/* --- single steps --- */

function live(): { session: Session; say: (message: SessionMessage) => readonly SessionEvent[] } {
    const state = {
        session: createSession(SCHEMA),
        say: (message: SessionMessage) => {
            const outcome = receive(state.session, message);
            state.session = outcome.session;
            return outcome.events;
        },
    };
    state.say({ type: "welcome", revision: 4, epoch: "e", last_edit: 0 });
    state.say({ type: "document", revision: 4, document: SCENE });
    return state;
}

const radius = (value: number): Operation => ({
    op: "set",
    at: "/nodes/body/params/radius",
    value,
});
const shownRadius = ({ shown }: Session) => shown?.nodes.get("body")?.params.radius;

test("an edit shows at once and gives way where it is refused", () => {
    const state = live();
    state.session = edit(state.session, [radius(3)], { label: "grow" }).session;
    expect(shownRadius(state.session)).toBe(3);
    state.session = takeOutbox(state.session).session;
    const events = state.say({
        type: "rejected",
        edit: 1,
        code: "invalid",
        place: "/nodes/body/params/radius",
        message: "3 is above the maximum 2",
    });
    expect(events).toMatchObject([{ kind: "rejected", pending: { label: "grow" } }]);
    expect(shownRadius(state.session)).toBe(1);
});

test("one group that was not sent yet is one edit", () => {
    const state = live();
    for (const value of [2, 3, 4]) {
        state.session = edit(state.session, [radius(value)], { group: "g" }).session;
    }
    const sent = takeOutbox(state.session);
    expect(sent.messages).toEqual([{ type: "edit", edit: 1, ops: [radius(4)], group: "g" }]);
    state.session = edit(sent.session, [radius(5)], { group: "g" }).session;
    expect(takeOutbox(state.session).messages).toMatchObject([{ edit: 2, group: "g" }]);
});

test("others' changes go below what is pending", () => {
    const state = live();
    state.session = edit(state.session, [radius(3)]).session;
    state.session = takeOutbox(state.session).session;
    state.say({ type: "changed", revision: 5, author: "you", ops: [radius(7)] });
    expect(shownRadius(state.session)).toBe(3);
    state.say({ type: "applied", edit: 1, revision: 6, durable: false, undo: 1, redo: 0 });
    expect(shownRadius(state.session)).toBe(3);
    expect(isSaved(state.session)).toBe(false);
    state.say({ type: "applied", edit: 1, revision: 6, durable: true, undo: 1, redo: 0 });
    expect(isSaved(state.session)).toBe(true);
});

test("a gap asks for the document", () => {
    const state = live();
    const events = state.say({ type: "changed", revision: 9, author: "you", ops: [radius(7)] });
    expect(events).toEqual([{ kind: "resync" }]);
    expect(state.session.fits).toBe(false);
    expect(state.say({ type: "changed", revision: 10, author: "you", ops: [] })).toEqual([]);
    state.say({ type: "document", revision: 10, document: SCENE });
    expect(state.session).toMatchObject({ fits: true, revision: 10 });
});

test("edits that a restarted server no longer has are sent again", () => {
    const state = live();
    state.session = edit(state.session, [radius(3)]).session;
    state.session = takeOutbox(state.session).session;
    state.say({ type: "applied", edit: 1, revision: 5, durable: false, undo: 1, redo: 0 });
    state.session = disconnect(state.session);
    state.say({ type: "welcome", revision: 4, epoch: "f", last_edit: 0 });
    state.say({ type: "document", revision: 4, document: SCENE });
    expect(shownRadius(state.session)).toBe(3);
    expect(takeOutbox(state.session).messages).toMatchObject([{ edit: 1, ops: [radius(3)] }]);
});

test("edits that were refused leave no gap after a reconnect", () => {
    const state = live();
    for (let edited = 1; edited <= 1500; edited++) {
        state.session = takeOutbox(edit(state.session, [radius(3)]).session).session;
        const why = { code: "invalid", place: "", message: "" };
        state.say({ type: "rejected", edit: edited, ...why });
    }
    state.session = disconnect(edit(edit(state.session, [radius(4)]).session, [radius(5)]).session);
    state.say({ type: "welcome", revision: 9, epoch: "f", last_edit: 7 });
    state.say({ type: "document", revision: 9, document: SCENE });
    expect(takeOutbox(state.session).messages).toMatchObject([{ edit: 8 }, { edit: 9 }]);
});

test("a cancelled gesture is forgotten, or undone where it was sent", () => {
    const state = live();
    state.session = edit(state.session, [radius(3)], { group: "g" }).session;
    const unsent = cancelGroup(state.session, "g");
    expect(shownRadius(unsent)).toBe(1);
    expect(takeOutbox(unsent).messages).toEqual([]);
    state.session = cancelGroup(takeOutbox(state.session).session, "g");
    expect(takeOutbox(state.session).messages).toEqual([]);
    state.say({ type: "applied", edit: 1, revision: 5, durable: true, undo: 1, redo: 0 });
    expect(takeOutbox(state.session).messages).toEqual([{ type: "undo", edit: 2 }]);
});

test("a gesture that is cancelled and refused after that undoes no older step", () => {
    const state = live();
    const problem = { code: "limit", place: "", message: "" };
    state.session = edit(state.session, [radius(2)], { group: "old" }).session;
    state.session = takeOutbox(state.session).session;
    state.say({ type: "applied", edit: 1, revision: 5, durable: true, undo: 1, redo: 0 });
    state.session = edit(state.session, [radius(3)], { group: "g" }).session;
    state.session = cancelGroup(takeOutbox(state.session).session, "g");
    state.session = edit(state.session, [radius(4)]).session;
    expect(isHeldBack(state.session)).toBe(true);
    expect(takeOutbox(state.session).messages).toEqual([]);
    state.say({ type: "rejected", edit: 2, ...problem });
    expect(isHeldBack(state.session)).toBe(false);
    expect(takeOutbox(state.session).messages).toMatchObject([{ type: "edit", edit: 4 }]);
    expect(stepsAhead(state.session).canUndo).toBe(true);
});

test("what was refused of a cancelled gesture undoes nothing else", () => {
    const state = live();
    const sendGrow = (value: number): void => {
        const grown = edit(state.session, [radius(value)], { group: "g" }).session;
        state.session = takeOutbox(grown).session;
    };
    const refuse = (edited: number): void => {
        const problem = { code: "limit", place: "", message: "" };
        state.say({ type: "rejected", edit: edited, ...problem });
    };
    const cancelled = () => takeOutbox(cancelGroup(state.session, "g")).messages;
    sendGrow(3);
    refuse(1);
    expect(cancelled()).toEqual([]);
    sendGrow(4);
    state.say({ type: "applied", edit: 2, revision: 5, durable: true, undo: 1, redo: 0 });
    sendGrow(5);
    refuse(3);
    expect(cancelled()).toMatchObject([{ type: "undo" }]);
});

test("an edit before the document is refused", () => {
    const { problem } = edit(createSession(SCHEMA), [radius(1)]);
    expect(problem?.code).toBe("unavailable");
});

test("undo and redo are offered by what is on its way", () => {
    const state = live();
    expect(stepsAhead(state.session)).toEqual({ canUndo: false, canRedo: false });
    state.session = edit(state.session, [radius(3)]).session;
    expect(stepsAhead(state.session)).toEqual({ canUndo: true, canRedo: false });
    state.session = askHistory(state.session, "undo");
    expect(stepsAhead(state.session)).toEqual({ canUndo: false, canRedo: true });
    state.session = askHistory(state.session, "redo");
    expect(stepsAhead(state.session)).toEqual({ canUndo: true, canRedo: false });
    state.session = askHistory(state.session, "undo");
    state.session = edit(state.session, [radius(5)]).session;
    expect(stepsAhead(state.session)).toEqual({ canUndo: true, canRedo: false });
});

test.each(["applied first", "changed first"])("an undo is counted once: %s", (order) => {
    const state = live();
    state.session = takeOutbox(edit(state.session, [radius(3)]).session).session;
    state.say({ type: "applied", edit: 1, revision: 5, durable: true, undo: 1, redo: 0 });
    state.session = takeOutbox(askHistory(state.session, "undo")).session;
    const ops = [radius(1)];
    const answers: readonly SessionMessage[] = [
        { type: "applied", edit: 2, revision: 6, durable: false, undo: 0, redo: 1 },
        { type: "changed", revision: 6, author: "me", edit: 2, ops },
    ];
    for (const answer of order === "applied first" ? answers : [...answers].reverse()) {
        state.say(answer);
        expect(stepsAhead(state.session)).toEqual({ canUndo: false, canRedo: true });
    }
    expect(state.session).toMatchObject({ undo: 0, redo: 1, pending: [] });
});

test("an undo tells what it left out, and a step that was left out whole is gone", () => {
    const welcome = {
        type: "welcome",
        revision: 1,
        epoch: 1,
        last_edit: 0,
        undo: 2,
        redo: 0,
    } as const;
    const ops: readonly Operation[] = [{ op: "set", at: "/nodes/a/params/radius", value: 1 }];
    let session = receive(createSession(SCHEMA), welcome).session;
    session = receive(session, { type: "document", revision: 1, document: SCENE }).session;
    session = askHistory(session, "undo");
    const refused = receive(session, {
        type: "rejected",
        edit: 1,
        code: "conflict",
        place: "/nodes/a/params/radius",
        message: "",
        skipped: ops,
    });
    expect(refused.events).toEqual([{ kind: "skipped", ops }]);
    expect(refused.session.undo).toBe(1);
    const asked = askHistory(refused.session, "undo");
    const answer = {
        type: "applied",
        edit: 2,
        revision: 2,
        durable: false,
        undo: 0,
        redo: 1,
    } as const;
    expect(receive(asked, { ...answer, skipped: ops }).events).toEqual([{ kind: "skipped", ops }]);
});
