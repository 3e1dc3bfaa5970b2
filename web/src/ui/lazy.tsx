/* SPDX-License-Identifier: MIT */
/* Parts that the first sight of the page does not need: loaded when the browser is idle, or when
 * they are asked for before that. By then they are there also without a connection. */
import { type ComponentType, lazy, Suspense } from "react";

type Load<P> = () => Promise<{ default: ComponentType<P> }>;

const loads: (() => Promise<unknown>)[] = [];

export function lazyPart<P extends object>(load: Load<P>): ComponentType<P> {
    const Part = lazy(load);
    loads.push(load);
    // biome-ignore lint/correctness/noComponentHookFactories: called once for each part, by its file
    return function LazyPart(props: P) {
        return (
            <Suspense fallback={null}>
                <Part {...props} />
            </Suspense>
        );
    };
}

/* Begins to load what may be asked for later. */
export function loadLazyParts(): void {
    const start = window.requestIdleCallback ?? ((run: () => void) => setTimeout(run, 500));
    start(() => {
        for (const load of loads) {
            load().catch(() => undefined) /* asked for again when it is needed */;
        }
    });
}
