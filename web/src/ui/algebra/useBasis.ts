/* SPDX-License-Identifier: MIT */
/* One basis at a time: begun, followed until it is over, cancelled when nobody looks any more. */
import { useCallback, useEffect, useRef, useState } from "react";
import { followQuestion } from "../../link/questionRest.ts";
import { RestError } from "../../link/rest.ts";
import { type Asked, advance, type Basis, isOver, NEW_BASIS } from "../../model/basis.ts";
import { useEditor } from "../state.ts";

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

export function useBasis(): Making {
    const { rest } = useEditor();
    const [basis, setBasis] = useState<Basis | null>(null);
    /* Of the one that is followed. */
    const request = useRef(new AbortController());

    const stop = useCallback(() => request.current.abort(), []);
    useEffect(() => stop, [stop]);

    const make = useCallback(
        (asked: Asked) => {
            stop();
            const own = new AbortController();
            request.current = own;
            let now = NEW_BASIS;
            const tell = (next: Basis): void => {
                now = next;
                if (!own.signal.aborted) {
                    setBasis(next);
                }
            };
            setBasis(now);
            followQuestion(
                rest.request,
                "groebner",
                { ...asked },
                (told) => tell(advance(now, told)),
                own.signal,
            ).catch((problem) => tell(failed(now, problem)));
        },
        [rest, stop],
    );
    const cancel = useCallback(() => {
        stop();
        setBasis((now) => (now && !isOver(now) ? { ...now, state: "cancelled" } : now));
    }, [stop]);
    return { basis, make, cancel };
}
