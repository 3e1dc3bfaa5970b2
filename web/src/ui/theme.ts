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

/* Whether a media query holds now. */
/* Is a finger what points here first? */
export const TOUCH = "(pointer: coarse)";

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
