/* SPDX-License-Identifier: MIT */
/* Pictures of the preset materials, drawn by the server as balls; each is asked for once. */
import { useEffect, useState } from "react";
import { ballScene, type Preset } from "../../model/presets.ts";
import { takeTurn } from "../scenes/turns.ts";
import { useEditor } from "../state.ts";

/* Pixels across. */
const SIZE = 128;

/* Object URLs by the preset's name. */
const drawn = new Map<string, string>();

/* Null until it is there. */
export function useBall(preset: Preset): string | null {
    const { rest } = useEditor();
    const [ball, setBall] = useState(drawn.get(preset.name) ?? null);
    useEffect(() => {
        if (drawn.has(preset.name)) {
            return;
        }
        const request = { width: SIZE, height: SIZE, format: "png", transparent: true } as const;
        return takeTurn(async (signal) => {
            const address = await rest.renderImage(ballScene(preset), request, signal);
            drawn.set(preset.name, address);
            setBall(address);
        });
    }, [rest, preset]);
    return ball;
}
