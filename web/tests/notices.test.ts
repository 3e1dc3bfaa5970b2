/* SPDX-License-Identifier: MIT */
/* Messages of the server become toasts: one for each place, and gone with its cause. */
import { expect, test } from "vitest";
import { Notices } from "../src/link/notices.ts";
import type { NoticeMessage } from "../src/link/protocol.ts";
import { readDocument } from "../src/model/documentJson.ts";
import type { Problem } from "../src/model/operation.ts";
import { pillOf } from "../src/model/pill.ts";
import { brokenCode, dropGone, isTooSlow } from "../src/model/problems.ts";
import { addNotice, createStores, NO_FRAME } from "../src/model/stores.ts";

const CODE = "/primitives/rod/code";
const code = "float sdf(vec3 p) { return length(p) - 1.0; }";

function setUp() {
    const stores = createStores(null);
    const document = readDocument({
        primitives: { rod: { code } },
        root: { id: "root", type: "union" },
    });
    const undo = [{ label: "change code" }];
    stores.document.setState(({ history }) => ({
        document,
        history: { ...history, undo } as never,
    }));
    return { stores, notices: new Notices(stores), shown: () => stores.notices.getState().notices };
}

const notice = (more: Partial<NoticeMessage>): NoticeMessage => ({
    type: "notice",
    level: "error",
    code: "too_slow",
    message: "This code took over 2.1 s to compile here (limit 2 s). The last picture stays.",
    place: CODE,
    measured: 2100,
    limit: 2000,
    ...more,
});

test("what was too slow may be tried again with more time, or undone", () => {
    const { notices, shown } = setUp();
    notices.fromServer(notice({}));
    expect(shown()).toHaveLength(1);
    expect(shown()[0]?.acts).toEqual([
        { kind: "retry", place: CODE, slow: true },
        { kind: "undo", label: "change code" },
    ]);
});

test("a crash asks for no more time", () => {
    const { notices, shown } = setUp();
    const crash = {
        type: "notice",
        level: "error",
        code: "crashed",
        message: "m",
        place: CODE,
    } as const;
    notices.fromServer(crash);
    expect(shown()[0]?.acts[0]).toEqual({ kind: "retry", place: CODE, slow: false });
});

test("there is one toast for each place, the newest", () => {
    const { notices, shown } = setUp();
    notices.fromServer(notice({ message: "first" }));
    notices.fromServer(notice({ place: "/nodes/root", code: "scene_left_out", message: "other" }));
    notices.fromServer(notice({ message: "second" }));
    expect(shown().map(({ message }) => message)).toEqual(["other", "second"]);
});

test("a toast is gone when its cause is", () => {
    for (const over of ["compiled", "retrying"]) {
        const { stores, notices, shown } = setUp();
        addNotice(stores.notices, { level: "info", code: "saved", message: "Saved." });
        notices.fromServer(notice({}));
        notices.fromServer(notice({ level: "info", code: over, place: "/primitives/other/code" }));
        expect(shown()).toHaveLength(2);
        expect(stores.document.getState().problems.size).toBe(1);
        notices.fromServer(notice({ level: "info", code: over }));
        expect(shown().map((one) => one.code)).toEqual(["saved"]);
        expect(stores.document.getState().problems.size).toBe(0);
    }
});

test("a toast is gone when what it is about is deleted", () => {
    const { stores, notices, shown } = setUp();
    notices.fromServer(notice({}));
    notices.dropGone();
    expect(shown()).toHaveLength(1);
    stores.document.setState({ document: readDocument({ root: { id: "root", type: "union" } }) });
    notices.dropGone();
    expect(shown()).toHaveLength(0);
});

const ROOT = "/nodes/root";
const leftOut = (more: Partial<NoticeMessage>): NoticeMessage =>
    notice({ place: ROOT, code: "scene_left_out", reason: "too_slow", ...more });

/* The pill tells the first problem that stands. */
const pillWith = (stores: ReturnType<typeof setUp>["stores"]) => {
    const { problems, revision, waiting } = stores.document.getState();
    const [problem = null] = brokenCode(problems);
    const input = { connection: "live", frame: NO_FRAME, moving: false, compiling: false } as const;
    return { problem, state: pillOf({ ...input, revision, waiting, problem }).state };
};

test.each([
    ["scene_left_out", "too_slow"],
    ["scene_left_out", "crashed"],
    ["too_slow", undefined],
    ["crashed", undefined],
] as const)(
    "the pill tells a scene that is given up, %s by %s, until it is tried again",
    (code, reason) => {
        const { stores, notices, shown } = setUp();
        notices.fromServer(notice({ place: ROOT, code, ...(reason && { reason }) }));
        notices.dropGone();
        stores.document.setState(({ problems, document }) => ({
            problems: dropGone(problems, document),
        }));
        expect(pillWith(stores)).toMatchObject({
            state: "givenUp",
            problem: { code, place: ROOT },
        });
        expect(isTooSlow(pillWith(stores).problem as Problem)).toBe(
            code === "too_slow" || reason === "too_slow",
        );
        expect(shown()[0]?.acts[0]).toMatchObject({ kind: "retry", place: ROOT });
        notices.fromServer(notice({ level: "info", code: "retrying", place: ROOT }));
        expect(pillWith(stores)).toEqual({ problem: null, state: "waiting" });
        expect(shown()).toHaveLength(0);
    },
);

test("only what was too slow asks for more time", () => {
    const { notices, shown } = setUp();
    const last = () => shown().at(-1)?.acts[0];
    notices.fromServer(leftOut({}));
    expect(last()).toEqual({ kind: "retry", place: ROOT, slow: true });
    notices.fromServer(leftOut({ reason: "crashed" }));
    expect(last()).toEqual({ kind: "retry", place: ROOT, slow: false });
});

test("a mistake in the code takes the place of what was too slow before", () => {
    const { stores, notices, shown } = setUp();
    notices.fromServer(notice({}));
    notices.fromServer(notice({ code: "compile", message: "no ;", line: 2, column: 1 }));
    expect(shown()).toHaveLength(0);
    expect(stores.document.getState().problems.get(CODE)?.line).toBe(2);
});

test("after a new welcome only what is told again stands", () => {
    const { stores, notices, shown } = setUp();
    notices.fromServer(notice({}));
    notices.welcome();
    expect(shown()).toHaveLength(0);
    expect(stores.document.getState().problems.size).toBe(0);
    notices.fromServer(notice({}));
    expect(shown()).toHaveLength(1);
});
