/* SPDX-License-Identifier: MIT */
/* What the cards of one graph share. */
import { createContext, useContext } from "react";
import type { Graph } from "../../model/graph.ts";
import type { MenuPlace } from "../widgets/Menu.tsx";

interface Shared {
    readonly graph: Graph;
    readonly openMenu: (at: MenuPlace) => void;
    /* The card that takes the focus when it is drawn, unless that has gone on. */
    readonly next: { current: string | null };
}

export const GraphContext = createContext<Shared | null>(null);

export function useShared(): Shared {
    const shared = useContext(GraphContext);
    if (shared === null) {
        throw new Error("no graph around this card");
    }
    return shared;
}
