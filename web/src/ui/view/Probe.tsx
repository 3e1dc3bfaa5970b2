/* SPDX-License-Identifier: MIT */
/* The value of the output that is shown, at the pixel under the pointer: one pixel of the same
 * picture that REST gives. Where it is asked for, also the node, the distance and the place there, at
 * once from the guide of the picture. */
import { useCallback, useEffect, useState } from "react";
import { distanceAt, surfaceAt } from "../../model/distances.ts";
import { nodeLabel } from "../../model/document.ts";
import { nodeAt, shownGuide } from "../../model/guide.ts";
import { projectionOf } from "../../model/projection.ts";
import type { Vector } from "../../model/transform.ts";
import { COLOR } from "../../model/view.ts";
import { shownCamera } from "../../overlay/shown.ts";
import type { Editor } from "../editor.ts";
import { useDocument, useEditor, useLink, useView } from "../state.ts";
import { t } from "../texts.ts";
import { type Place, pixelAt } from "./pixel.ts";
import "./view.css";

/* A pointer that moves on is not asked for. */
const REST_MS = 90;

/* Where the pointer is over the picture, whether or not anybody asks: what is switched on by a key
 * knows it at once. What lay over the picture and goes lets the pointer enter without a move. */
function usePlace(element: Element | null): Place | null {
    const [place, setPlace] = useState<Place | null>(null);
    useEffect(() => {
        if (!(element instanceof HTMLElement)) {
            return;
        }
        const ended = new AbortController();
        const options = { signal: ended.signal };
        const there = ({ clientX, clientY }: PointerEvent): void => setPlace({ clientX, clientY });
        for (const type of ["pointerenter", "pointermove", "pointerdown"] as const) {
            element.addEventListener(type, there, options);
        }
        element.addEventListener("pointerleave", () => setPlace(null), options);
        return () => ended.abort();
    }, [element]);
    return place;
}

/* Asks when the pointer rests; null while it is not over the picture. */
function useValues(
    active: boolean,
    element: Element | null,
    place: Place | null,
): readonly number[] | null {
    const editor = useEditor();
    const [values, setValues] = useState<readonly number[] | null>(null);
    const revision = useDocument((state) => state.revision);
    // biome-ignore lint/correctness/useExhaustiveDependencies: another revision has other values
    useEffect(() => {
        if (!active || element === null || place === null) {
            setValues(null);
            return;
        }
        const asked = new AbortController();
        const timer = setTimeout(() => {
            const { aov } = editor.stores.view.getState();
            pixelAt(editor, element, place, aov, asked.signal).then(setValues, () => undefined);
        }, REST_MS);
        return () => {
            clearTimeout(timer);
            asked.abort();
        };
    }, [editor, active, element, place, revision]);
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
function pointedAt(
    { stores }: Editor,
    element: Element,
    { clientX, clientY }: Place,
): Pointed | null {
    const guide = shownGuide(stores.link.getState());
    const camera = shownCamera(stores);
    if (!guide || !camera) {
        return null;
    }
    const box = element.getBoundingClientRect();
    const [x, y] = [clientX - box.left, clientY - box.top];
    const size = { width: element.clientWidth, height: element.clientHeight };
    return {
        node: nodeAt(guide, x / size.width, y / size.height),
        place: surfaceAt(guide, projectionOf(camera, size), { x, y }),
        distance: distanceAt(guide, x / size.width, y / size.height),
    };
}

/* What is there in the picture that is shown. */
function UnderPointer({ element, place }: { element: Element; place: Place }) {
    const editor = useEditor();
    useLink(({ guide }) => guide);
    useLink(({ frame }) => frame);
    const pointed = pointedAt(editor, element, place);
    return pointed && <Told pointed={pointed} />;
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
    const find = useCallback(
        (own: Element | null) =>
            setElement(own?.closest(".view")?.querySelector(".view-picture") ?? null),
        [],
    );
    const place = usePlace(element);
    const values = useValues((aov !== COLOR || probing) && !isolated, element, place);
    return (
        <div className="outputs-probe" ref={find} data-testid="probe">
            {values && (
                <output className="glass outputs-value" aria-label={t("output.value")}>
                    {values.map(number).join("  ")}
                </output>
            )}
            {probing && element && place && <UnderPointer element={element} place={place} />}
        </div>
    );
}
