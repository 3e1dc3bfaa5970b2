/* SPDX-License-Identifier: MIT */
/* Light, dark, or as the system says: an attribute on the root element that theme.css reads. */
import { useEffect, useSyncExternalStore } from "react";
import { useView } from "./state.ts";

export function useTheme(): void {
    const theme = useView((view) => view.preferences.theme);
    useEffect(() => {
        if (theme === "auto") {
            delete document.documentElement.dataset.theme;
        } else {
            document.documentElement.dataset.theme = theme;
        }
    }, [theme]);
}

/* From here on the tree and the inspector have a column each; below the second one, a sheet. */
export const WIDE = "(min-width: 1100px)";
export const NARROW = "(max-width: 719px)";

/* Is a finger what points here first? */
export const TOUCH = "(pointer: coarse)";

/* Whether a media query holds now. */
export function useMedia(query: string): boolean {
    return useSyncExternalStore(
        (onChange) => {
            const media = window.matchMedia(query);
            media.addEventListener("change", onChange);
            return () => media.removeEventListener("change", onChange);
        },
        () => window.matchMedia(query).matches,
    );
}
