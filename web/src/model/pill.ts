/* SPDX-License-Identifier: MIT */
/* What the pill under the picture says: how the picture on screen stands to the newest state, told
 * by revisions. Pure. */
import type { Problem } from "./operation.ts";
import { COMPILE, LEFT_OUT } from "./problems.ts";
import type { Connection, FrameInfo } from "./stores.ts";

export type PillState =
    /* No connection: the picture is old, or there is none. */
    | "offline"
    /* The server has ended the connection, or has no such scene: nothing comes any more. */
    | "ended"
    /* What was to be drawn was too slow, or crashed: the picture is the last good one. */
    | "givenUp"
    /* The code does not compile: the same. */
    | "kept"
    /* There is no picture yet. */
    | "waiting"
    | "compiling"
    /* The picture lacks the newest edits. */
    | "behind"
    /* A hand moves the camera or a value. */
    | "moving"
    /* The picture is of an older view. */
    | "drawing"
    /* Everything is in it, not yet in full quality. */
    | "refining"
    | "final";

export interface PillInput {
    readonly connection: Connection;
    readonly frame: FrameInfo;
    /* Of the document that is shown, and edits on top of it. */
    readonly revision: number;
    readonly waiting: number;
    readonly moving: boolean;
    readonly compiling: boolean;
    /* What stands in the way of the newest state. */
    readonly problem: Problem | null;
}

export interface Pill {
    readonly state: PillState;
    /* Edits that the picture lacks. */
    readonly behind: number;
    /* Of the view's resolution. */
    readonly percent: number;
    /* Rounds of samples; 0 where the picture has not come so far. */
    readonly round: number;
    readonly rounds: number;
}

/* Does a problem keep the picture from what is looked at? A scene that is left out gets no better
 * pictures either. */
function isBlocked({ frame, problem }: PillInput, behind: number): boolean {
    const unfinished = frame.state !== "lossless" || frame.outdated;
    return (
        problem !== null &&
        (frame.stale ||
            behind > 0 ||
            (problem.code === LEFT_OUT ? unfinished : frame.state === "none"))
    );
}

function stateOf(input: PillInput, behind: number): PillState {
    const { connection, frame, problem, compiling, moving } = input;
    if (connection === "offline" || connection === "refused") {
        return connection === "offline" ? "offline" : "ended";
    }
    if (isBlocked(input, behind)) {
        return problem?.code === COMPILE ? "kept" : "givenUp";
    }
    if (compiling) {
        return "compiling";
    }
    if (frame.state === "none") {
        return "waiting";
    }
    if (moving) {
        return "moving";
    }
    if (behind > 0) {
        return "behind";
    }
    if (frame.outdated) {
        return "drawing";
    }
    return frame.state === "lossless" ? "final" : "refining";
}

export function pillOf(input: PillInput): Pill {
    const { frame, revision, waiting } = input;
    const behind = frame.state === "none" ? 0 : Math.max(0, revision - frame.revision) + waiting;
    const still = frame.state === "still";
    return {
        state: stateOf(input, behind),
        behind,
        percent: Math.round(frame.scale * 100),
        round: still && frame.rounds > 1 ? frame.round : 0,
        rounds: frame.rounds,
    };
}
