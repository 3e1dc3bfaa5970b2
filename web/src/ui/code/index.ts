/* SPDX-License-Identifier: MIT */
/* The editor of code, loaded later. */
import { lazyPart } from "../lazy.tsx";

export const CodePanel = lazyPart(() => import("./CodePanel.tsx"));
