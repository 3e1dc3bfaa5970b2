/* SPDX-License-Identifier: MIT */
/* The whole scene as text, loaded later. */
import { lazyPart } from "../lazy.tsx";

export const TextPanel = lazyPart(() => import("./TextPanel.tsx"));
