/* SPDX-License-Identifier: MIT */

/* Rejects where the bytes are damaged. */
export async function inflate(bytes: Blob): Promise<ArrayBuffer> {
    const stream = bytes.stream().pipeThrough(new DecompressionStream("deflate"));
    return await new Response(stream).arrayBuffer();
}
