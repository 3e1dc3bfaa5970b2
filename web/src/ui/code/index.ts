/* SPDX-License-Identifier: MIT */
/* The editor of code, loaded later. */
import { later } from "../later.tsx";

export const CodePanel = later(() => import("./CodePanel.tsx"));
