/* SPDX-License-Identifier: MIT */
/* A picture as a file: what is chosen, why it cannot be, and what the file is called. */
import { limitOf, type Schema } from "./schema.ts";
import { text } from "./texts.ts";
import { COLOR } from "./view.ts";

export const FORMATS = ["png", "jpg", "npy", "hdr"] as const;
export type Format = (typeof FORMATS)[number];

export interface PictureChoice {
    readonly width: number;
    readonly height: number;
    /* Names of outputs, at least one. */
    readonly outputs: readonly string[];
    /* A level of quality; null: as the scene says. */
    readonly level: string | null;
    readonly transparent: boolean;
    readonly format: Format;
}

export const FIRST_CHOICE: PictureChoice = {
    width: 1920,
    height: 1080,
    outputs: [COLOR],
    level: null,
    transparent: false,
    format: "png",
};

export const SIZES: readonly (readonly [number, number])[] = [
    [1280, 720],
    [1920, 1080],
    [3840, 2160],
    [1024, 1024],
    [2048, 2048],
];

export function toggleOutput(choice: PictureChoice, name: string): PictureChoice {
    const others = choice.outputs.filter((one) => one !== name);
    const outputs = others.length < choice.outputs.length ? others : [...others, name];
    return { ...choice, outputs };
}

/* Why there is no such file, or null. */
export function whyNotPicture(schema: Schema, choice: PictureChoice): string | null {
    const { width, height, outputs, format, transparent } = choice;
    const most = limitOf(schema, "image_pixels", Number.POSITIVE_INFINITY);
    const numbersOnly = schema.outputs.find(
        ({ name, picture }) => outputs.includes(name) && !picture,
    );
    if (outputs.length === 0) {
        return text("picture.noOutput");
    }
    if (width * height > most) {
        return text("picture.large", { most: Math.floor(most / 1e6) });
    }
    if (numbersOnly && format !== "npy") {
        return text("picture.numbersOnly", { name: numbersOnly.name });
    }
    if (format === "hdr" && outputs.some((name) => name !== COLOR)) {
        return text("picture.lightAlone");
    }
    if (format === "jpg" && outputs.length > 1) {
        return text("picture.oneInJpeg");
    }
    return format === "jpg" && transparent ? text("picture.opaqueJpeg") : null;
}

/* Several outputs come in one file: a ZIP, which NumPy calls .npz. */
export function extensionOf({ outputs, format }: PictureChoice): string {
    if (outputs.length < 2) {
        return format;
    }
    return format === "npy" ? "npz" : "zip";
}
