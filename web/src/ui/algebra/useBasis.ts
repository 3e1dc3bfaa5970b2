/* SPDX-License-Identifier: MIT */
/* One basis at a time: begun, looked at until it is over, cancelled when nobody looks any more. */
import { useCallback, useEffect, useRef, useState } from "react";
import { beginBasis, cancelBasis, lookAtBasis } from "../../link/basisRest.ts";
import { RestError } from "../../link/rest.ts";
import { type Asked, advance, type Basis, isOver, NEW_BASIS } from "../../model/basis.ts";
import { useEditor } from "../state.ts";

const LOOK_MS = 150;

export interface Making {
    readonly basis: Basis | null;
    make(asked: Asked): void;
    cancel(): void;
}

function failed(basis: Basis, problem: unknown): Basis {
    const { place, message, line, column } =
        problem instanceof RestError ? problem : new RestError(0, "", "", String(problem));
    return { ...basis, state: "failed", failure: { place, message, line, column } };
}

const pause = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, LOOK_MS));

export function useBasis(): Making {
    const { rest } = useEditor();
    const [basis, setBasis] = useState<Basis | null>(null);
    /* The run that is looked at; another one or none ends it. */
    const current = useRef<{ id: string } | null>(null);

    const stop = useCallback(() => {
        const run = current.current;
        current.current = null;
        if (run?.id) {
            cancelBasis(rest.request, run.id).catch(() => undefined);
        }
    }, [rest]);
    useEffect(() => stop, [stop]);

    const make = useCallback(
        async (asked: Asked) => {
            stop();
            const run = { id: "" };
            current.current = run;
            let now = NEW_BASIS;
            setBasis(now);
            const tell = (next: Basis): boolean => {
                now = next;
                if (current.current === run) {
                    setBasis(next);
                }
                return current.current === run && !isOver(next);
            };
            try {
                run.id = await beginBasis(rest.request, asked);
                while (
                    tell(advance(now, await lookAtBasis(rest.request, run.id, now.steps.length)))
                ) {
                    await pause();
                }
            } catch (problem) {
                tell(failed(now, problem));
            }
            if (current.current === run) {
                current.current = null;
            } else {
                cancelBasis(rest.request, run.id).catch(() => undefined);
            }
        },
        [rest, stop],
    );
    const cancel = useCallback(() => {
        stop();
        setBasis((now) => (now && !isOver(now) ? { ...now, state: "cancelled" } : now));
    }, [stop]);
    return { basis, make, cancel };
}
