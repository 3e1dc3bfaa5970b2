/* SPDX-License-Identifier: MIT */
/* For what can be closed from inside: the focus that it has goes to the picture, not to nothing. */
import { type RefObject, useLayoutEffect, useRef } from "react";

export function useLeftFocus(): RefObject<HTMLElement | null> {
    const own = useRef<HTMLElement>(null);
    useLayoutEffect(() => {
        const { current } = own;
        return () => {
            if (current?.contains(document.activeElement)) {
                document.querySelector<HTMLElement>("[data-region-focus]")?.focus();
            }
        };
    }, []);
    return own;
}
