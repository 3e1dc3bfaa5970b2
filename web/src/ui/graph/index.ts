/* SPDX-License-Identifier: MIT */
/* The graph, loaded later. */
import { lazyPart } from "../lazy.tsx";

export const GraphPanel = lazyPart(() => import("./GraphPanel.tsx"));
