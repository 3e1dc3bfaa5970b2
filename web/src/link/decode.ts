/* SPDX-License-Identifier: MIT */
/* Puts frames together from their messages and decodes them. Runs in the worker and, where there
 * is none, in the page. */
import type { Depths } from "../model/warp.ts";
import { type Chains, pixelsOf } from "./deltas.ts";
import { splitDepths } from "./depths.ts";
import type { FrameHeader, Packet } from "./protocol.ts";

/* A frame whose payload is complete. Times by performance.now(). */
export interface Frame {
    readonly header: FrameHeader;
    readonly parts: readonly Uint8Array<ArrayBuffer>[];
    readonly firstAt: number;
    readonly lastAt: number;
}

/* More than the largest picture that the server makes; a larger header is damaged. */
const MOST_BYTES = 1 << 28;

/* Collects the messages of one frame at a time. A new header gives up the frame before; parts that
 * belong to no open frame, and frames with too many bytes, are dropped. */
export class FrameAssembler {
    #header: FrameHeader | null = null;
    #parts: Uint8Array<ArrayBuffer>[] = [];
    #missing = 0;
    #firstAt = 0;

    push(packet: Packet, now: number): Frame | null {
        if (packet.kind === "head") {
            this.reset();
            if (packet.header.payloadBytes > MOST_BYTES) {
                return null;
            }
            this.#header = packet.header;
            this.#missing = packet.header.payloadBytes;
            this.#firstAt = now;
        } else if (packet.number !== this.#header?.number) {
            return null;
        }
        this.#parts.push(packet.payload);
        this.#missing -= packet.payload.length;
        if (this.#missing > 0 || !this.#header) {
            return null;
        }
        const whole = this.#missing === 0;
        const frame = {
            header: this.#header,
            parts: this.#parts,
            firstAt: this.#firstAt,
            lastAt: now,
        };
        this.reset();
        return whole ? frame : null;
    }

    reset(): void {
        this.#header = null;
        this.#parts = [];
        this.#missing = 0;
    }
}

export interface Decoded {
    readonly bitmap: ImageBitmap;
    /* Null where the server tells none. */
    readonly depths: Depths | null;
}

/* The pixels of a frame, exactly as encoded. Rejects where the payload is damaged, or where it
 * differs from a picture that is not there. Frames are told in the order in which they come. */
export async function decode({ header, parts }: Frame, chains: Chains): Promise<Decoded> {
    const payload = new Blob([...parts], { type: `image/${header.codec}` });
    const split = header.depths
        ? splitDepths(payload, header)
        : Promise.resolve({ picture: payload, depths: null });
    const picture = split.then((one) => one.picture);
    if (header.chain > 0 && !header.delta) {
        chains.keep(header, picture);
    }
    const bitmap = header.delta ? chains.compose(header, picture) : picture.then(pixelsOf);
    return { bitmap: await bitmap, depths: (await split).depths };
}
