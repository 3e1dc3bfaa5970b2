/* SPDX-License-Identifier: MIT */
/* Which scene the address names: `#/scene/ID`, or none: the start page. */
import { useSyncExternalStore } from "react";

const PATTERN = /^#\/scene\/([A-Za-z0-9_.-]{1,64})$/;

export function sceneOfAddress(): string | null {
    return PATTERN.exec(window.location.hash)?.[1] ?? null;
}

export function addressOf(scene: string | null): string {
    return scene === null ? "#/" : `#/scene/${scene}`;
}

export function goTo(scene: string | null): void {
    window.location.hash = addressOf(scene);
}

function subscribe(onChange: () => void): () => void {
    window.addEventListener("hashchange", onChange);
    return () => window.removeEventListener("hashchange", onChange);
}

export function useRoute(): string | null {
    return useSyncExternalStore(subscribe, sceneOfAddress);
}
