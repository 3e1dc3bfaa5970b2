/* SPDX-License-Identifier: MIT */
/* Measures the stream: frames per second, milliseconds per stage, bytes, and the time from
 * sending a view to showing it. Only this machine's clock is used. */
import type { Statistics } from "../model/stores.ts";
import type { Frame } from "./decode.ts";

interface Sample {
    readonly at: number;
    readonly bytes: number;
    /* queue, march, light, read, encode, receive, decode, present */
    readonly stages: readonly number[];
}

const WINDOW_MS = 1000;
/* Stage times stay on screen when the picture rests: averages of the last frames. */
const STAGE_FRAMES = 20;
const PHOTON_SAMPLES = 200;
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
        const server = [header.queue, header.march, header.light, header.read, header.encode];
        this.#samples.push({
            at: now,
            bytes: header.payloadBytes,
            stages: [
                ...server.map((us) => us / 1000),
                frame.lastAt - frame.firstAt,
                decodedAt - frame.lastAt,
                now - decodedAt,
            ],
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

    /* A new connection: numbers of frames start again. */
    reset(): void {
        this.#sentAt.clear();
        this.#shownInput = 0;
    }

    read(now: number): Statistics {
        const recent = this.#samples.filter((sample) => sample.at >= now - WINDOW_MS);
        const last = this.#samples.slice(-STAGE_FRAMES);
        const mean = (pick: (sample: Sample) => number): number =>
            last.reduce((sum, sample) => sum + pick(sample), 0) / Math.max(1, last.length);
        const stage = (index: number): number => mean((sample) => sample.stages[index] ?? 0);
        const sorted = [...this.#photons].sort((a, b) => a - b);
        return {
            fps: recent.length / (WINDOW_MS / 1000),
            queue: stage(0),
            march: stage(1),
            light: stage(2),
            read: stage(3),
            encode: stage(4),
            receive: stage(5),
            decode: stage(6),
            present: stage(7),
            photonP50: percentile(sorted, 0.5),
            photonP95: percentile(sorted, 0.95),
            bytesPerFrame: mean((sample) => sample.bytes),
            bytesPerSecond:
                recent.reduce((sum, sample) => sum + sample.bytes, 0) / (WINDOW_MS / 1000),
            dropped: this.#dropped,
        };
    }
}
