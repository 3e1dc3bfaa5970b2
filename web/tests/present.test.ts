/* SPDX-License-Identifier: MIT */
/* Frames on a canvas of another shape. */
import { expect, test } from "vitest";
import { Presenter, type Surface } from "../src/link/present.ts";
import type { FrameHeader } from "../src/link/protocol.ts";

/* The draws on a surface: left edge and width of what was drawn there. */
function surface(): { surface: Surface; drawn: [number, number][] } {
    const drawn: [number, number][] = [];
    const brush = {
        drawImage: (_image: unknown, ...places: number[]) => {
            const [left = 0, , width = 0] = places.slice(-4);
            drawn.push([left, width]);
        },
        clearRect: () => undefined,
    };
    return { surface: { width: 1, height: 1, getContext: () => brush as never }, drawn };
}

test("a frame that is narrower than the view is continued to both sides", () => {
    const { surface: canvas, drawn } = surface();
    const presenter = new Presenter();
    presenter.setSurface(canvas);
    presenter.resize(400, 100);
    const bitmap = { width: 50, height: 50, close: () => undefined } as ImageBitmap;
    presenter.show(bitmap, { viewWidth: 200, viewHeight: 100 } as FrameHeader, null);
    expect(drawn).toEqual([
        [0, 100],
        [300, 100],
        [100, 200],
    ]);
});
