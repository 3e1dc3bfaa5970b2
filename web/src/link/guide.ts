/* SPDX-License-Identifier: MIT */
/* Guides from the bytes of their frames. */
import type { Guide } from "../model/guide.ts";
import type { Frame } from "./decode.ts";

async function inflate(bytes: Blob): Promise<ArrayBuffer> {
    const stream = bytes.stream().pipeThrough(new DecompressionStream("deflate"));
    return await new Response(stream).arrayBuffer();
}

/* Rejects where the payload is damaged. */
export async function decodeGuide({ header, parts }: Frame): Promise<Guide> {
    const whole = await new Blob([...parts]).arrayBuffer();
    const view = new DataView(whole);
    const ids: string[] = [];
    let at = 2;
    for (let count = view.getUint16(0, true); count > 0; count--) {
        const start = at + 1;
        at = start + view.getUint8(at);
        ids.push(new TextDecoder().decode(new Uint8Array(whole, start, at - start)));
    }
    const pixels = new DataView(await inflate(new Blob([whole.slice(at)])));
    const { input, revision, width, height } = header;
    if (pixels.byteLength !== 2 * width * height) {
        throw new Error("a guide of another size than its pixels");
    }
    const indices = Uint16Array.from({ length: width * height }, (_, i) =>
        pixels.getUint16(2 * i, true),
    );
    return { input, revision, width, height, ids, indices };
}
