/* SPDX-License-Identifier: MIT */
/* Pictures that come as what differs from earlier ones: keeps the last picture of each chain and
 * puts the squares that have changed into it. */
import type { FrameHeader } from "./protocol.ts";

/* Pixels of a square. */
const SIDE = 16;

const EXACT = { premultiplyAlpha: "none", colorSpaceConversion: "none" } as const;

/* The pixels of a file, exactly as encoded. */
export const pixelsOf = (file: Blob): Promise<ImageBitmap> => createImageBitmap(file, EXACT);

export interface Delta {
    /* Those that have changed, by rows from the top. */
    readonly squares: readonly number[];
    /* The picture of them, as many in a row as fit. */
    readonly atlas: Blob;
}

export async function readDelta(payload: Blob): Promise<Delta> {
    const view = new DataView(await payload.arrayBuffer());
    const runs = view.getUint16(0, true);
    const squares: number[] = [];
    for (let i = 0; i < runs; i++) {
        let next = view.getUint16(2 + 4 * i, true);
        for (let k = view.getUint16(4 + 4 * i, true); k > 0; k--) {
            squares.push(next++);
        }
    }
    return { squares, atlas: payload.slice(2 + 4 * runs, payload.size, payload.type) };
}

/* The last picture of a chain. Its file is decoded once more when something differs from it. */
interface Kept {
    link: number;
    readonly header: FrameHeader;
    readonly file: Promise<Blob>;
    brush: Promise<OffscreenCanvasRenderingContext2D> | null;
}

async function brushOf({ header, file }: Kept): Promise<OffscreenCanvasRenderingContext2D> {
    const bitmap = await pixelsOf(await file);
    const canvas = new OffscreenCanvas(header.width, header.height);
    const brush = canvas.getContext("2d", { alpha: false }) as OffscreenCanvasRenderingContext2D;
    brush.imageSmoothingEnabled = false;
    brush.drawImage(bitmap, 0, 0);
    bitmap.close();
    return brush;
}

async function drawSquares(
    brush: OffscreenCanvasRenderingContext2D,
    { squares, atlas }: Delta,
): Promise<void> {
    if (squares.length === 0) {
        return;
    }
    const bitmap = await pixelsOf(atlas);
    const across = Math.ceil(brush.canvas.width / SIDE);
    const columns = bitmap.width / SIDE;
    squares.forEach((square, i) => {
        const from = [(i % columns) * SIDE, Math.floor(i / columns) * SIDE] as const;
        const to = [(square % across) * SIDE, Math.floor(square / across) * SIDE] as const;
        brush.drawImage(bitmap, ...from, SIDE, SIDE, ...to, SIDE, SIDE);
    });
    bitmap.close();
}

export class Chains {
    readonly #kept = new Map<number, Kept>();

    static areThere(): boolean {
        return typeof OffscreenCanvas === "function";
    }

    clear(): void {
        this.#kept.clear();
    }

    /* A whole picture. Frames are told in the order in which they come. */
    keep(header: FrameHeader, file: Promise<Blob>): void {
        file.catch(() => null);
        this.#kept.set(header.chain, { link: header.link, header, file, brush: null });
    }

    /* The picture that differs so from the last one of its chain. Rejects where that is not there. */
    async compose(header: FrameHeader, payload: Promise<Blob>): Promise<ImageBitmap> {
        const kept = this.#kept.get(header.chain);
        if (!kept || header.link !== (kept.link + 1) % 256) {
            throw new Error(`no picture before ${header.number}`);
        }
        kept.link = header.link;
        const before = kept.brush ?? brushOf(kept);
        const drawn = before.then(async (brush) => {
            await drawSquares(brush, await readDelta(await payload));
            return { brush, bitmap: await createImageBitmap(brush.canvas) };
        });
        kept.brush = drawn.then(({ brush }) => brush);
        kept.brush.catch(() => null);
        return (await drawn).bitmap;
    }
}
