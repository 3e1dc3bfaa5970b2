/* SPDX-License-Identifier: MIT */
/* What a search for an equation does while it lasts, and the way to end it. */
import { Button } from "../widgets/Button.tsx";
import { surfaceText } from "./surfaceTexts.ts";
import type { Search } from "./useEquation.ts";

/* As text; "" where the search is over. */
export function searchText({ state, found, step }: Search): string {
    if (state === "cancelled") {
        return surfaceText("cancelled");
    }
    if (state === "over" || found !== null) {
        return "";
    }
    const { text, ms } = step ?? { text: "", ms: 0 };
    return step === null
        ? surfaceText("busy")
        : `${surfaceText("busy")} ${surfaceText("step", { text, seconds: (ms / 1000).toFixed(1) })}`;
}

export function CancelSearch({ search }: { search: Search }) {
    return search.state === "busy" && search.found === null ? (
        <Button look="outline" onClick={search.cancel}>
            {surfaceText("cancel")}
        </Button>
    ) : null;
}
