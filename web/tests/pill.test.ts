/* SPDX-License-Identifier: MIT */
/* The pill tells the truth: it compares revisions. */
import { expect, test } from "vitest";
import { type PillInput, pillOf } from "../src/model/pill.ts";
import { type FrameInfo, NO_FRAME } from "../src/model/stores.ts";

const FRAME: FrameInfo = {
    ...NO_FRAME,
    state: "lossless",
    number: 9,
    revision: 7,
    width: 640,
    height: 360,
};

const REST: PillInput = {
    connection: "live",
    frame: FRAME,
    revision: 7,
    waiting: 0,
    moving: false,
    compiling: false,
    problem: null,
};

const told = (part: Partial<PillInput>) => pillOf({ ...REST, ...part });
const problem = (code: string) => ({ code, place: "/nodes/a/params/code", message: "" });

test("a lossless picture of the newest state is final, of an older one it is behind", () => {
    expect(told({}).state).toBe("final");
    expect(told({ revision: 9 })).toMatchObject({ state: "behind", behind: 2 });
    expect(told({ waiting: 1 })).toMatchObject({ state: "behind", behind: 1 });
    expect(told({ revision: 8, waiting: 2 }).behind).toBe(3);
});

test("it moves only while something moves", () => {
    const frame: FrameInfo = { ...FRAME, state: "moving", scale: 0.25 };
    expect(told({ frame, moving: true })).toMatchObject({ state: "moving", percent: 25 });
    expect(told({ frame }).state).toBe("refining");
    expect(told({ moving: true }).state).toBe("moving");
});

test("rounds are told where there are some", () => {
    const still: FrameInfo = { ...FRAME, state: "still", round: 2, rounds: 3 };
    expect(told({ frame: still })).toMatchObject({ state: "refining", round: 2, rounds: 3 });
    expect(told({ frame: { ...still, round: 1, rounds: 1 } }).round).toBe(0);
});

test("a connection that the server has ended is told as that", () => {
    expect(told({ connection: "refused" }).state).toBe("ended");
    expect(told({ connection: "refused", compiling: true }).state).toBe("ended");
    expect(told({ connection: "refused", frame: NO_FRAME }).state).toBe("ended");
});

test("without a connection the picture is old, whatever it was", () => {
    expect(told({ connection: "offline" }).state).toBe("offline");
    expect(told({ connection: "offline", compiling: true }).state).toBe("offline");
    expect(told({ connection: "connecting", frame: NO_FRAME }).state).toBe("waiting");
});

test("before the first picture it waits or compiles", () => {
    expect(told({ frame: NO_FRAME })).toMatchObject({ state: "waiting", behind: 0 });
    expect(told({ frame: NO_FRAME, compiling: true }).state).toBe("compiling");
});

test("a compiling state is told before that the picture lacks edits", () => {
    const frame = { ...FRAME, stale: true };
    expect(told({ frame, revision: 9, compiling: true }).state).toBe("compiling");
});

test("what cannot be drawn is told as long as the picture is an older one", () => {
    const frame = { ...FRAME, stale: true };
    expect(told({ frame, problem: problem("compile") }).state).toBe("kept");
    expect(told({ revision: 8, problem: problem("compile") }).state).toBe("kept");
    expect(told({ frame, problem: problem("too_slow") }).state).toBe("givenUp");
    expect(told({ frame: NO_FRAME, problem: problem("crashed") }).state).toBe("givenUp");
    expect(told({ problem: problem("compile") }).state).toBe("final");
});

test("a scene that is left out is given up whatever its picture lacks", () => {
    const left = problem("scene_left_out");
    expect(told({ frame: NO_FRAME, problem: left }).state).toBe("givenUp");
    const frame: FrameInfo = { ...FRAME, state: "still", round: 1, rounds: 3 };
    expect(told({ frame, problem: left }).state).toBe("givenUp");
    expect(told({ frame: { ...FRAME, outdated: true }, problem: left }).state).toBe("givenUp");
    expect(told({ problem: left, moving: true, frame }).state).toBe("givenUp");
    expect(told({ problem: left }).state).toBe("final");
});

test("a picture of another view than the newest is not final", () => {
    const frame = { ...FRAME, outdated: true };
    expect(told({ frame }).state).toBe("drawing");
    expect(told({ frame, moving: true }).state).toBe("moving");
    expect(told({ frame, revision: 8 }).state).toBe("behind");
});
