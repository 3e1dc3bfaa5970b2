/* SPDX-License-Identifier: MIT */
/* Starts the page. */
import { createRoot } from "react-dom/client";
import { App } from "./ui/App.tsx";
import { createEditor } from "./ui/editor.ts";

const root = document.getElementById("root");
if (root !== null) {
    createRoot(root).render(<App editor={createEditor()} />);
}
