/* SPDX-License-Identifier: MIT */
// @vitest-environment jsdom
/* Where the focus goes when what has it goes. */
import { act, type ReactNode, useState } from "react";
import { expect, test, vi } from "vitest";
import { Region } from "../src/ui/layout/Region.tsx";
import { Button } from "../src/ui/widgets/Button.tsx";
import { useLeftFocus } from "../src/ui/widgets/leftFocus.ts";
import { Menu, MenuItem } from "../src/ui/widgets/Menu.tsx";
import { prepareShow } from "./show.ts";

const show = prepareShow();
const find = (selector: string) => document.querySelector<HTMLElement>(selector);

function Drawer({ children }: { children: ReactNode }) {
    return <section ref={useLeftFocus()}>{children}</section>;
}

function Page() {
    const [open, setOpen] = useState(true);
    return (
        <>
            <button type="button" data-region-focus="" />
            {open && (
                <Drawer>
                    <Button onClick={() => setOpen(false)}>Close</Button>
                </Drawer>
            )}
        </>
    );
}

test("a panel that is closed from inside leaves the focus to the picture", async () => {
    await show(<Page />);
    const close = find("section button");
    close?.focus();
    await act(async () => close?.click());
    expect(document.activeElement).toBe(find("[data-region-focus]"));
});

function Row({ children }: { children: ReactNode }) {
    const [there, setThere] = useState(true);
    const remove = <MenuItem onSelect={() => setThere(false)}>Remove</MenuItem>;
    return there ? <Menu trigger={<Button>Actions</Button>}>{remove}</Menu> : children;
}

/* biome-ignore lint/a11y/noAutofocus: as where a name is typed */
const input = <input autoFocus />;

test.each([
    ["to its region", null, "[data-region]"],
    ["where its choice leads", input, "input"],
])("a menu that takes its own button away leaves the focus %s", async (_, instead, place) => {
    await show(
        <Region name="Scene">
            <Row>{instead}</Row>
        </Region>,
    );
    const button = find("[aria-haspopup]");
    button?.focus();
    await act(async () => button?.click());
    await vi.waitFor(() => expect(find("[role='menu']")).not.toBeNull());
    await act(async () => find("[role='menuitem']")?.focus());
    await act(async () => find("[role='menuitem']")?.click());
    await vi.waitFor(() => expect(find("[role='menu']")).toBeNull());
    expect(document.activeElement).toBe(find(place));
});
