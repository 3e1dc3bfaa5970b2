/* SPDX-License-Identifier: MIT */
// @vitest-environment jsdom
/* Buttons that a second finger, another pointer or a screen reader presses while a hand holds something. */
import { act } from "react";
import { createRoot } from "react-dom/client";
import { afterEach, expect, test, vi } from "vitest";
import { addNotice, createStores } from "../src/model/stores.ts";
import type { Editor } from "../src/ui/editor.ts";
import { Bar } from "../src/ui/layout/Bar.tsx";
import { Notices } from "../src/ui/layout/Notices.tsx";
import { EditorContext } from "../src/ui/state.ts";

afterEach(() => vi.unstubAllGlobals());

test("neither the bar nor a message undoes anything under a hand", async () => {
    vi.stubGlobal("IS_REACT_ACT_ENVIRONMENT", true);
    const stores = createStores(window.localStorage);
    const done: string[] = [];
    const editor = {
        stores,
        undo: () => done.push("undo"),
        redo: () => done.push("redo"),
    } as unknown as Editor;
    const label = "delete ball";
    const step = { group: "", label, selection: [] };
    stores.document.setState({
        ...{ canUndo: true, canRedo: true },
        history: { undo: [step], redo: [step] },
    });
    const acts = [{ kind: "undo" as const, label }];
    addNotice(stores.notices, { level: "info", code: "deleted", message: "Ball is gone.", acts });
    const element = document.createElement("div");
    const root = createRoot(element);
    await act(async () =>
        root.render(
            <EditorContext.Provider value={editor}>
                <Bar narrow={false} />
                <Notices />
            </EditorContext.Provider>,
        ),
    );
    const pressAll = () =>
        act(async () => {
            for (const button of element.querySelectorAll<HTMLElement>(
                "[data-command='edit.undo'], [data-command='edit.redo'], .notice-acts button",
            )) {
                button.click();
            }
        });
    await act(async () => stores.view.setState({ held: true }));
    await pressAll();
    expect(done).toEqual([]);
    await act(async () => stores.view.setState({ held: false }));
    await pressAll();
    expect(done).toEqual(["undo", "redo", "undo"]);
    await act(async () => root.unmount());
});
