/* SPDX-License-Identifier: MIT */
// @vitest-environment jsdom
/* Menus at a point, and the picture, which takes a finger for itself. */
import { act } from "react";
import { createRoot } from "react-dom/client";
import { afterEach, expect, test, vi } from "vitest";
import { MenuItem, PointMenu } from "../src/ui/widgets/Menu.tsx";

afterEach(() => vi.unstubAllGlobals());

test("a finger outside closes a menu at a point, one inside does not", async () => {
    vi.stubGlobal("IS_REACT_ACT_ENVIRONMENT", true);
    const root = createRoot(document.createElement("div"));
    const close = vi.fn();
    await act(async () =>
        root.render(
            <PointMenu at={{ x: 1, y: 1 }} label="Menu" onClose={close}>
                <MenuItem onSelect={() => undefined}>Item</MenuItem>
            </PointMenu>,
        ),
    );
    const press = (target: Element | null) =>
        act(async () => {
            const event = new MouseEvent("pointerdown", { bubbles: true });
            target?.dispatchEvent(Object.assign(event, { pointerType: "touch" }));
        });
    await press(document.querySelector("[role='menuitem']"));
    expect(close).not.toHaveBeenCalled();
    await press(document.body);
    expect(close).toHaveBeenCalledOnce();
    await act(async () => root.unmount());
});
