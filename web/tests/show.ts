/* SPDX-License-Identifier: MIT */
/* Shows parts of the page in the document of a test. */
import { act, type ReactNode } from "react";
import { createRoot, type Root } from "react-dom/client";
import { afterEach, beforeEach, vi } from "vitest";

/* For all tests of a file; what is shown is gone after each. */
export function prepareShow(): (part: ReactNode) => Promise<void> {
    let root: Root;
    let element: HTMLElement;
    beforeEach(() => {
        vi.stubGlobal("IS_REACT_ACT_ENVIRONMENT", true);
        element = document.body.appendChild(document.createElement("div"));
        root = createRoot(element);
    });
    afterEach(async () => {
        await act(async () => root.unmount());
        element.remove();
        vi.unstubAllGlobals();
    });
    return (part) => act(async () => root.render(part));
}
