/* SPDX-License-Identifier: MIT */
/* The search for the equation of a parametric surface, begun anew after each change of what is
 * asked. A change of ranges alone keeps the equation, which does not depend on them. */
import { useCallback, useEffect, useRef, useState } from "react";
import { RestError } from "../../link/rest.ts";
import { type Implicit, implicitize, type SearchStep } from "../../link/surfaceRest.ts";
import type { PartTexts, SurfaceRange } from "../../model/surface.ts";
import { useEditor } from "../state.ts";

/* A pause in changes after which the server is asked. */
const ASK_MS = 300;

export interface Search {
    readonly state: "busy" | "over" | "cancelled";
    readonly found: Implicit | null;
    readonly problem: RestError | null;
    readonly step: SearchStep | null;
    cancel(): void;
}

interface Result extends Omit<Search, "cancel"> {
    /* What was asked for the equation that is found; "": none is. */
    readonly of: string;
}
const BEGUN: Result = { state: "busy", found: null, problem: null, step: null, of: "" };

const asProblem = (problem: unknown): RestError =>
    problem instanceof RestError ? problem : new RestError(0, "unreachable", "", String(problem));

/* Ranges of letters that the texts are not in are left out, and those that run back: all of them. */
function rangesAsked(
    texts: PartTexts,
    ranges: Readonly<Record<string, SurfaceRange>>,
): Readonly<Record<string, SurfaceRange>> {
    const words = new Set(`${texts.x} ${texts.y} ${texts.z}`.match(/[A-Za-z_]\w*/g) ?? []);
    const used = Object.entries(ranges).filter(([letter]) => words.has(letter));
    const fit = used.length === 2 && used.every(([, [low, high]]) => low < high);
    return fit ? Object.fromEntries(used) : {};
}

export function useEquation(
    texts: PartTexts,
    method: string | null,
    ranges: Readonly<Record<string, SurfaceRange>>,
    /* Of the box that the surface is cut by; null: the least one around the patch. */
    size: readonly number[] | null = null,
): Search {
    const { rest } = useEditor();
    const [result, setResult] = useState(BEGUN);
    const request = useRef(new AbortController());
    const { x, y, z } = texts;
    const about = JSON.stringify({ x, y, z, ...(method === null ? {} : { method }) });
    const within = JSON.stringify({
        ...rangesAsked(texts, ranges),
        ...(size === null ? {} : { size }),
    });
    useEffect(() => {
        const own = new AbortController();
        const tell = (next: (now: Result) => Result): void => {
            if (!own.signal.aborted) {
                setResult(next);
            }
        };
        request.current = own;
        setResult((now) => (now.of === about ? now : BEGUN));
        const timer = setTimeout(() => {
            implicitize(
                rest.request,
                { ...JSON.parse(about), ...JSON.parse(within) },
                (step) => tell((now) => ({ ...now, step })),
                own.signal,
            ).then(
                (found) => tell(() => ({ ...BEGUN, state: "over", found, of: about })),
                (problem) => tell(() => ({ ...BEGUN, state: "over", problem: asProblem(problem) })),
            );
        }, ASK_MS);
        return () => {
            clearTimeout(timer);
            own.abort();
        };
    }, [rest, about, within]);
    const cancel = useCallback(() => {
        request.current.abort();
        setResult({ ...BEGUN, state: "cancelled" });
    }, []);
    return { ...result, cancel };
}
