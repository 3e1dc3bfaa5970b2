/* SPDX-License-Identifier: MIT */
// @vitest-environment jsdom
/* The search for the equation of a surface: what is shown while it is begun, cancelled, begun anew. */
import { act } from "react";
import { createRoot, type Root } from "react-dom/client";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { SurfaceRange } from "../src/model/surface.ts";
import type { Editor } from "../src/ui/editor.ts";
import { type Search, useEquation } from "../src/ui/fields/useEquation.ts";
import { EditorContext } from "../src/ui/state.ts";

const TEXTS = { x: "s*t", y: "s", z: "t^2" };
const OVER = { state: "over", answer: { equation: "x^2-y^2*z", drawable: true } };
const FAILED = { state: "over", error: { code: "limit", message: "too large" } };
const PAUSE_MS = 1000; /* longer than those of a search */

let root: Root;
let search: Search;
let told: object;

const request = async () => ({ json: async () => ({ id: "q", ...told }) });
const editor = { rest: { request } } as unknown as Editor;

function Probe({ most }: { most: number }) {
    const ranges: Record<string, SurfaceRange> = { s: [0, most], t: [0, 1] };
    search = useEquation(TEXTS, null, ranges);
    return null;
}

/* In a range up to `most`; `next`: what the server tells from then on. */
async function look(most: number, next: object): Promise<void> {
    told = next;
    await act(async () =>
        root.render(
            <EditorContext value={editor}>
                <Probe most={most} />
            </EditorContext>,
        ),
    );
}
const pass = () => act(async () => void (await vi.advanceTimersByTimeAsync(PAUSE_MS)));

beforeEach(() => {
    vi.stubGlobal("IS_REACT_ACT_ENVIRONMENT", true);
    vi.useFakeTimers();
    root = createRoot(document.createElement("div"));
});
afterEach(async () => {
    await act(async () => root.unmount());
    vi.useRealTimers();
    vi.unstubAllGlobals();
});

test("a search that was cancelled is begun anew as one that was never asked", async () => {
    await look(1, { state: "running" });
    await pass();
    act(() => search.cancel());
    await pass();
    expect(search.state).toBe("cancelled");
    await look(2, { state: "running" });
    expect([search.state, search.found]).toEqual(["busy", null]);
    await look(2, OVER);
    await pass();
    expect([search.state, search.found?.equation]).toEqual(["over", "x^2-y^2*z"]);
});

test("an equation stays while others of its ranges are looked for, a problem does not", async () => {
    await look(1, OVER);
    await pass();
    await look(2, { state: "running" });
    expect(search.found?.equation).toBe("x^2-y^2*z");
    await look(3, FAILED);
    await pass();
    expect([search.found, search.problem?.message]).toEqual([null, "too large"]);
    await look(4, { state: "running" });
    expect([search.state, search.problem]).toEqual(["busy", null]);
});
