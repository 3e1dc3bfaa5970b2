/* SPDX-License-Identifier: MIT */
/* What an output has at a place of the picture: one pixel of the same picture that REST gives. */
import { readNpy } from "../../link/npy.ts";
import { printCamera } from "../../model/camera.ts";
import { sectionMember } from "../../model/section.ts";
import type { Editor } from "../editor.ts";

export interface Place {
    readonly clientX: number;
    readonly clientY: number;
}

export async function pixelAt(
    { stores, rest }: Editor,
    picture: Element,
    { clientX, clientY }: Place,
    output: string,
    signal: AbortSignal,
): Promise<readonly number[] | null> {
    const { scene } = stores.document.getState();
    const box = picture.getBoundingClientRect();
    const [width, height] = [Math.round(box.width), Math.round(box.height)];
    const pixel = (at: number, length: number): number =>
        Math.min(length - 1, Math.max(0, Math.floor(at)));
    const x = pixel(clientX - box.left, width);
    const y = pixel(clientY - box.top, height);
    const address = rest.imageUrl(scene ?? "", {
        width,
        height,
        region: [x, y, 1, 1],
        format: "npy",
        outputs: [output],
        camera: printCamera(stores.camera.getState().camera),
        ...sectionMember(stores.view.getState().section),
    });
    return readNpy(await (await rest.fetchFile(address, signal)).arrayBuffer());
}
