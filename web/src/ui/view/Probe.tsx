/* SPDX-License-Identifier: MIT */
/* The value of the output that is shown, at the pixel under the pointer: one pixel of the same
 * picture that REST gives. Where it is asked for, also the node, the distance and the place there, at
 * once from the guide of the picture. */
import { useEffect, useRef, useState } from "react";
import { distanceAt, surfaceAt } from "../../model/distances.ts";
import { nodeLabel } from "../../model/document.ts";
import { nodeAt, shownGuide } from "../../model/guide.ts";
import { projectionOf, type Spot } from "../../model/projection.ts";
import type { Vector } from "../../model/transform.ts";
import { COLOR } from "../../model/view.ts";
import { shownCamera } from "../../overlay/shown.ts";
import type { Editor } from "../editor.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { pixelAt } from "./pixel.ts";
import "./view.css";

/* A pointer that moves on is not asked for. */
const REST_MS = 90;

/* Asks when the pointer rests; null while it is not over the picture. */
function useValues(active: boolean, element: Element | null): readonly number[] | null {
    const editor = useEditor();
    const [values, setValues] = useState<readonly number[] | null>(null);
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
                pixelAt(
                    editor,
                    element,
                    event,
                    editor.stores.view.getState().aov,
                    asked.signal,
                ).then(setValues, () => undefined);
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

interface Pointed {
    readonly node: string | null;
    readonly place: Vector | null;
    readonly distance: number;
}

/* Null while the picture has no guide. */
function pointedAt({ stores }: Editor, element: Element, { x, y }: Spot): Pointed | null {
    const guide = shownGuide(stores.link.getState());
    const camera = shownCamera(stores);
    if (!guide || !camera) {
        return null;
    }
    const size = { width: element.clientWidth, height: element.clientHeight };
    return {
        node: nodeAt(guide, x / size.width, y / size.height),
        place: surfaceAt(guide, projectionOf(camera, size), { x, y }),
        distance: distanceAt(guide, x / size.width, y / size.height),
    };
}

/* Null while the pointer is not over the picture. */
function usePointed(active: boolean, element: Element | null): Pointed | null {
    const editor = useEditor();
    const [pointed, setPointed] = useState<Pointed | null>(null);
    useEffect(() => {
        if (!active || !(element instanceof HTMLElement)) {
            setPointed(null);
            return;
        }
        const ended = new AbortController();
        let last: Spot | null = null;
        const tell = (): void => setPointed(last && pointedAt(editor, element, last));
        const move = ({ clientX, clientY }: PointerEvent): void => {
            const box = element.getBoundingClientRect();
            last = { x: clientX - box.left, y: clientY - box.top };
            tell();
        };
        const leave = (): void => {
            last = null;
            tell();
        };
        element.addEventListener("pointermove", move, { signal: ended.signal });
        element.addEventListener("pointerleave", leave, { signal: ended.signal });
        const stop = editor.stores.link.subscribe(
            (now, before) => (now.guide !== before.guide || now.frame !== before.frame) && tell(),
        );
        return () => {
            ended.abort();
            stop();
        };
    }, [editor, active, element]);
    return pointed;
}

function Told({ pointed: { node, place, distance } }: { pointed: Pointed }) {
    const label = useDocument(({ document }) => {
        const shown = document?.nodes.get(node ?? "");
        return shown ? nodeLabel(shown) : null;
    });
    const rows = [
        ["probe.node", label ?? t(place ? "probe.floor" : "probe.nothing")],
        ["probe.distance", number(distance)],
        ["probe.place", place ? place.map(number).join("  ") : "–"],
    ] as const;
    return (
        <dl className="glass outputs-told" data-testid="pointed">
            {rows.map(([key, value]) => (
                <div key={key}>
                    <dt>{t(key)}</dt>
                    <dd>{value}</dd>
                </div>
            ))}
        </dl>
    );
}

export default function Probe() {
    const aov = useView((view) => view.aov);
    const probing = useView((view) => view.preferences.probe);
    /* What is isolated is drawn for this page alone; REST draws the whole scene. */
    const isolated = useView((view) => view.isolated.length > 0);
    const [element, setElement] = useState<Element | null>(null);
    const values = useValues((aov !== COLOR || probing) && !isolated, element);
    const pointed = usePointed(probing, element);
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
            {pointed && <Told pointed={pointed} />}
        </div>
    );
}
