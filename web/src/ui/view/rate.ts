/* SPDX-License-Identifier: MIT */
/* Frames per second and milliseconds in words. Pure. */
import type { LinkState, Statistics } from "../../model/stores.ts";
import { t } from "../texts.ts";

/* Milliseconds of one frame, from the server's first stage to the screen. */
export function frameTime({ stages, receive, decode, present }: Statistics): number {
    return stages.reduce((sum, time) => sum + time, receive + decode + present);
}

type Input = Pick<LinkState, "statistics" | "frame" | "compiling" | "connection">;

/* Nothing more comes after the final picture of what is looked at. */
export function rateText({ statistics: numbers, frame, compiling, connection }: Input): string {
    if (numbers === null || connection !== "live") {
        return t("stats.open");
    }
    if (numbers.fps < 1) {
        const done = frame.state === "lossless" && !frame.stale && !frame.outdated;
        return t(done && compiling === null ? "stats.idle" : "stats.busy");
    }
    const ms = numbers.photonP50 ?? frameTime(numbers);
    return t("stats.fps", { fps: Math.round(numbers.fps), ms: Math.round(ms) });
}
