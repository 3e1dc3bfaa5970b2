/* SPDX-License-Identifier: MIT */
/* Measures the stream: frames per second, milliseconds per stage, bytes, and the time from
 * sending a view to showing it. Only this machine's clock is used. */
import type { FrameState, Statistics } from "../model/stores.ts";
import type { Frame } from "./decode.ts";
import { frameState } from "./protocol.ts";

interface Sample {
    readonly at: number;
    readonly bytes: number;
    readonly state: FrameState;
    readonly stages: readonly number[];
    readonly receive: number;
    readonly decode: number;
    readonly present: number;
}

const WINDOW_MS = 1000;
/* Times stay on screen when the picture rests: averages of the last frames, in which each counts
 * FADE times the one after it, so that numbers can be read and yet follow. */
const STAGE_FRAMES = 20;
const FADE = 0.8;
const PHOTON_SAMPLES = 200;
/* How many of the last ones say how long the way is now; of fewer than half it is not known. */
const LATENCY_SAMPLES = 9;
const VIEWS_KEPT = 512;

function percentile(sorted: readonly number[], share: number): number | null {
    return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? null;
}

export class Meter {
    #samples: Sample[] = [];
    #photons: number[] = [];
    #sentAt = new Map<number, number>();
    #shownInput = 0;
    #dropped = 0;

    viewSent(seq: number, now: number): void {
        this.#sentAt.set(seq, now);
        for (const old of this.#sentAt.keys()) {
            if (this.#sentAt.size <= VIEWS_KEPT) {
                break;
            }
            this.#sentAt.delete(old);
        }
    }

    frameDropped(): void {
        this.#dropped++;
    }

    frameShown(frame: Frame, decodedAt: number, now: number): void {
        const { header } = frame;
        this.#samples.push({
            at: now,
            bytes: header.payloadBytes,
            state: frameState(header),
            stages: header.stages.map((us) => us / 1000),
            receive: frame.lastAt - frame.firstAt,
            decode: decodedAt - frame.lastAt,
            present: now - decodedAt,
        });
        const sent = this.#sentAt.get(header.input);
        if (header.input > this.#shownInput && sent !== undefined) {
            this.#photons.push(now - sent);
            this.#photons.splice(0, this.#photons.length - PHOTON_SAMPLES);
        }
        this.#shownInput = Math.max(this.#shownInput, header.input);
        while (
            this.#samples.length > STAGE_FRAMES &&
            (this.#samples[0]?.at ?? now) < now - WINDOW_MS
        ) {
            this.#samples.shift();
        }
    }

    /* Milliseconds from sending a view to showing it; null: not known yet. */
    latency(): number | null {
        const last = this.#photons.slice(-LATENCY_SAMPLES).sort((a, b) => a - b);
        return 2 * last.length > LATENCY_SAMPLES ? percentile(last, 0.5) : null;
    }

    /* A new connection: numbers of frames start again. */
    reset(): void {
        this.#sentAt.clear();
        this.#shownInput = 0;
    }

    read(now: number): Statistics {
        const recent = this.#samples.filter((sample) => sample.at >= now - WINDOW_MS);
        const newest = this.#samples.at(-1);
        const alike = this.#samples.filter(({ state }) => state === newest?.state).reverse();
        const weights = alike.map((_, age) => FADE ** age);
        const sum = weights.reduce((total, weight) => total + weight, 0);
        const mean = (pick: (sample: Sample) => number): number =>
            alike.reduce((total, sample, age) => total + pick(sample) * (weights[age] ?? 0), 0) /
            Math.max(1, sum);
        const sorted = [...this.#photons].sort((a, b) => a - b);
        return {
            fps: recent.length / (WINDOW_MS / 1000),
            state: newest?.state ?? "none",
            stages: (newest?.stages ?? []).map((_, i) => mean(({ stages }) => stages[i] ?? 0)),
            receive: mean(({ receive }) => receive),
            decode: mean(({ decode }) => decode),
            present: mean(({ present }) => present),
            photonP50: percentile(sorted, 0.5),
            photonP95: percentile(sorted, 0.95),
            bytesPerFrame: mean(({ bytes }) => bytes),
            bytesPerSecond:
                recent.reduce((sum, sample) => sum + sample.bytes, 0) / (WINDOW_MS / 1000),
            dropped: this.#dropped,
        };
    }
}
