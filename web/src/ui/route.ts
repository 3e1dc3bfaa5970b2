/* SPDX-License-Identifier: MIT */
/* Which scene the address names: `/s/ID`, or `/`: the start page. The server answers both with the
 * same page. */
import { type MouseEvent, useSyncExternalStore } from "react";

const PATTERN = /^\/s\/([A-Za-z0-9_.-]{1,64})$/;

export function sceneOfAddress(): string | null {
    return PATTERN.exec(window.location.pathname)?.[1] ?? null;
}

export function addressOf(scene: string | null): string {
    return scene === null ? "/" : `/s/${scene}`;
}

export function goTo(scene: string | null): void {
    window.history.pushState(null, "", addressOf(scene));
    window.dispatchEvent(new PopStateEvent("popstate"));
}

/* What a click on a link to `scene` does: plain ones change the page in place, others (a new tab)
 * are the browser's. */
export const follow = (scene: string | null) => (event: MouseEvent) => {
    if (event.button === 0 && !event.metaKey && !event.ctrlKey && !event.shiftKey) {
        event.preventDefault();
        goTo(scene);
    }
};

function subscribe(onChange: () => void): () => void {
    window.addEventListener("popstate", onChange);
    return () => window.removeEventListener("popstate", onChange);
}

export function useRoute(): string | null {
    return useSyncExternalStore(subscribe, sceneOfAddress);
}
