/* SPDX-License-Identifier: MIT */
/* The value of the output that is shown, at the pixel under the pointer: one pixel of the same
 * picture that REST gives. */
import { useEffect, useRef, useState } from "react";
import { readNpy } from "../../link/npy.ts";
import { printCamera } from "../../model/camera.ts";
import { COLOR } from "../../model/view.ts";
import type { Editor } from "../editor.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import "./view.css";

/* A pointer that moves on is not asked for. */
const REST_MS = 90;

type Values = readonly number[];

async function valuesAt(
    { stores, rest }: Editor,
    element: Element,
    { clientX, clientY }: PointerEvent,
    signal: AbortSignal,
): Promise<Values | null> {
    const { scene } = stores.document.getState();
    const box = element.getBoundingClientRect();
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
        outputs: [stores.view.getState().aov],
        camera: printCamera(stores.camera.getState().camera),
    });
    return readNpy(await (await rest.fetchFile(address, signal)).arrayBuffer());
}

/* Asks when the pointer rests; null while it is not over the picture. */
function useValues(active: boolean, element: Element | null): Values | null {
    const editor = useEditor();
    const [values, setValues] = useState<Values | null>(null);
    const revision = useDocument((state) => state.revision);
    const last = useRef<PointerEvent | null>(null);
    // biome-ignore lint/correctness/useExhaustiveDependencies: another revision has other values
    useEffect(() => {
        if (!active || !(element instanceof HTMLElement)) {
            setValues(null);
            return;
        }
        const ended = new AbortController();
        let asked = new AbortController();
        let timer: ReturnType<typeof setTimeout> | undefined;
        const ask = (event: PointerEvent): void => {
            last.current = event;
            clearTimeout(timer);
            asked.abort();
            asked = new AbortController();
            timer = setTimeout(() => {
                valuesAt(editor, element, event, asked.signal).then(setValues, () => undefined);
            }, REST_MS);
        };
        const leave = (): void => {
            last.current = null;
            clearTimeout(timer);
            asked.abort();
            setValues(null);
        };
        element.addEventListener("pointermove", ask, { signal: ended.signal });
        element.addEventListener("pointerdown", ask, { signal: ended.signal });
        element.addEventListener("pointerleave", leave, { signal: ended.signal });
        if (last.current) {
            ask(last.current);
        }
        return () => {
            ended.abort();
            asked.abort();
            clearTimeout(timer);
        };
    }, [editor, active, element, revision]);
    return values;
}

const number = (value: number): string =>
    Number.isFinite(value) ? String(Number(value.toPrecision(4))) : "∞";

export function Probe() {
    const aov = useView((view) => view.aov);
    /* What is isolated is drawn for this page alone; REST draws the whole scene. */
    const isolated = useView((view) => view.isolated.length > 0);
    const [element, setElement] = useState<Element | null>(null);
    const values = useValues(aov !== COLOR && !isolated, element);
    return (
        <div
            className="outputs-probe"
            ref={(place) =>
                setElement(place?.closest(".view")?.querySelector(".view-picture") ?? null)
            }
            data-testid="probe"
        >
            {values && (
                <output className="glass outputs-value" aria-label={t("output.value")}>
                    {values.map(number).join("  ")}
                </output>
            )}
        </div>
    );
}
