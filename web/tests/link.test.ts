/* SPDX-License-Identifier: MIT */
// @vitest-environment jsdom
/* The link and its engine on a socket that the test answers. */
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { Author } from "../src/link/author.ts";
import { createLink, type Link } from "../src/link/link.ts";
import type { JsonObject } from "../src/model/json.ts";
import { createStores, type Stores } from "../src/model/stores.ts";
import { SCENE, SCHEMA } from "./fixture.ts";

class FakeSocket {
    static readonly OPEN = 1;
    static all: FakeSocket[] = [];
    readonly url: string;
    readonly sent: JsonObject[] = [];
    readyState = FakeSocket.OPEN;
    onopen: () => void = () => undefined;
    onmessage: (event: { data: string }) => void = () => undefined;
    onclose: (event: { reason: string }) => void = () => undefined;

    constructor(url: string) {
        this.url = url;
        FakeSocket.all.push(this);
    }

    send(text: string): void {
        this.sent.push(JSON.parse(text) as JsonObject);
    }

    close(): void {
        this.readyState = 3;
    }

    /* The server's. */
    say(message: JsonObject): void {
        this.onmessage({ data: JSON.stringify(message) });
    }

    welcome(revision: number): void {
        this.say({ type: "welcome", revision, epoch: "e", last_edit: 0, key: "k", renderer: {} });
    }

    lose(): void {
        this.readyState = 3;
        this.onclose({ reason: "" });
    }
}

const AUTHOR: Author = { id: "me", key: null, keep: () => undefined, renew: () => undefined };

let stores: Stores;
let link: Link;

beforeEach(() => {
    FakeSocket.all = [];
    vi.stubGlobal("WebSocket", FakeSocket);
    stores = createStores(null);
    link = createLink(stores, { base: "", token: null });
});
afterEach(() => {
    link.destroy();
    vi.unstubAllGlobals();
});

/* Waits for the `count`th connection and answers what the page says first. */
async function greeting(count: number): Promise<{ socket: FakeSocket; hello: JsonObject }> {
    const socket = await vi.waitFor(() => {
        expect(FakeSocket.all).toHaveLength(count);
        return FakeSocket.all[count - 1] as FakeSocket;
    });
    socket.onopen();
    return { socket, hello: socket.sent[0] as JsonObject };
}

test("a page that has fallen out of step asks for the whole document until it has it", async () => {
    link.connect("a", SCHEMA, AUTHOR);
    const { socket: first } = await greeting(1);
    first.welcome(4);
    first.say({ type: "document", revision: 4, document: SCENE });
    first.say({ type: "changed", revision: 9, author: "you", ops: [] });
    const { socket: second, hello } = await greeting(2);
    expect(hello).not.toHaveProperty("revision");
    second.welcome(9);
    second.lose();
    const { socket: third, hello: again } = await greeting(3);
    expect(again).not.toHaveProperty("revision");
    third.welcome(9);
    third.say({ type: "document", revision: 9, document: SCENE });
    third.lose();
    const { hello: resumed } = await greeting(4);
    expect(resumed).toMatchObject({ revision: 9, epoch: "e" });
});

test("what a scene that was left is refused for does not close the next one", async () => {
    const answers: ((response: Response) => void)[] = [];
    vi.stubGlobal("fetch", () => new Promise((resolve) => void answers.push(resolve)));
    link.connect("a", SCHEMA, AUTHOR);
    const { socket } = await greeting(1);
    socket.lose();
    link.connect("b", SCHEMA, AUTHOR);
    const { socket: second } = await greeting(2);
    second.welcome(4);
    expect(answers).toHaveLength(1);
    answers[0]?.(new Response(null, { status: 404 }));
    await new Promise((resolve) => setTimeout(resolve));
    expect(stores.link.getState().connection).toBe("live");
    expect(second.readyState).toBe(FakeSocket.OPEN);
});

test("what is cancelled is undone when the server has taken what was on its way, else not", async () => {
    link.connect("a", SCHEMA, AUTHOR);
    const { socket } = await greeting(1);
    socket.welcome(4);
    socket.say({ type: "document", revision: 4, document: SCENE });
    const asked = () => socket.sent.filter(({ type }) => type === "edit" || type === "undo");
    const dragAndCancel = async (count: number): Promise<void> => {
        const gesture = link.gesture("drag");
        gesture.edit([{ op: "set", at: "/nodes/head/params/radius", value: count }]);
        await vi.waitFor(() => expect(asked()).toHaveLength(count));
        gesture.cancel();
        expect(asked()).toHaveLength(count);
    };
    await dragAndCancel(1);
    socket.say({ type: "applied", edit: 1, revision: 5, durable: true, undo: 1, redo: 0 });
    expect(asked().slice(1)).toEqual([{ type: "undo", edit: 2 }]);
    await dragAndCancel(3);
    socket.say({ type: "rejected", edit: 3, code: "limit", place: "", message: "no" });
    expect(asked()).toHaveLength(3);
    expect(stores.document.getState().history.undo).toHaveLength(1);
    expect(stores.notices.getState().notices).toEqual([]);
});
