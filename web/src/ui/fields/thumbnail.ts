/* SPDX-License-Identifier: MIT */
/* A small picture of an uploaded file: what the browser decodes itself, and Radiance HDR, whose
 * pixels are three mantissas and a shared exponent (Ward, "Real Pixels", 1991), lines of them
 * run-length coded. */

/* Sides of the picture in pixels; a panorama is twice as wide as high. */
const WIDTH = 240;
const HEIGHT = 120;

interface Pixels {
    readonly width: number;
    readonly height: number;
    /* Four bytes a pixel. */
    readonly bytes: Uint8Array;
}

/* One line of the run-length code, component by component; answers where the next begins. */
function readLine(file: Uint8Array, start: number, line: Uint8Array, width: number): number {
    let at = start + 4;
    for (let part = 0; part < 4; part++) {
        for (let x = 0; x < width; ) {
            const count = file[at++] ?? 0;
            const run = count > 128;
            const length = run ? count - 128 : count;
            if (length === 0 || x + length > width || at >= file.length) {
                throw new Error("a line is damaged");
            }
            for (let i = 0; i < length; i++, x++) {
                line[4 * x + part] = file[run ? at : at + i] ?? 0;
            }
            at += run ? 1 : length;
        }
    }
    return at;
}

/* The bytes of an HDR file as they are coded; null: it is none, or of an older form. */
export function readHdr(file: Uint8Array): Pixels | null {
    const head = new TextDecoder("latin1").decode(file.subarray(0, 4096));
    const size = /\n\n-Y (\d+) \+X (\d+)\n/.exec(head);
    const [height, width] = [Number(size?.[1]), Number(size?.[2])];
    if (!head.startsWith("#?") || size === null || width < 8 || width > 32767) {
        return null;
    }
    let at = size.index + size[0].length;
    if (file[at] !== 2 || file[at + 1] !== 2 || file.length < at + 8 * height) {
        return null;
    }
    const bytes = new Uint8Array(4 * width * height);
    for (let y = 0; y < height; y++) {
        at = readLine(file, at, bytes.subarray(4 * width * y, 4 * width * (y + 1)), width);
    }
    return { width, height, bytes };
}

/* Light to a byte of a screen: brightness 1 is not yet white, so that lamps show. */
function toByte(light: number): number {
    return Math.round(255 * (light / (1 + light)) ** (1 / 2.2));
}

function drawHdr({ width, height, bytes }: Pixels): ImageData {
    const image = new ImageData(WIDTH, HEIGHT);
    for (let i = 0; i < WIDTH * HEIGHT; i++) {
        const x = Math.floor(((i % WIDTH) * width) / WIDTH);
        const y = Math.floor((Math.floor(i / WIDTH) * height) / HEIGHT);
        const from = 4 * (y * width + x);
        const scale = 2 ** ((bytes[from + 3] ?? 0) - 136);
        for (let c = 0; c < 3; c++) {
            image.data[4 * i + c] = toByte((bytes[from + c] ?? 0) * scale);
        }
        image.data[4 * i + 3] = 255;
    }
    return image;
}

/* Rejected where the file cannot be shown here. */
export async function thumbnail(file: Blob, canvas: HTMLCanvasElement): Promise<void> {
    const pixels = readHdr(new Uint8Array(await file.arrayBuffer()));
    canvas.width = WIDTH;
    canvas.height = HEIGHT;
    const context = canvas.getContext("2d");
    if (pixels !== null) {
        context?.putImageData(drawHdr(pixels), 0, 0);
        return;
    }
    const bitmap = await createImageBitmap(file);
    context?.drawImage(bitmap, 0, 0, WIDTH, HEIGHT);
    bitmap.close();
}
