/* SPDX-License-Identifier: MIT */
/* One of the things that open below the picture, or in a phone's sheet. */
import type { Drawer } from "../../model/view.ts";
import { CodePanel } from "../code/index.ts";
import { GraphPanel } from "../graph/index.ts";
import { useView } from "../state.ts";
import { TextPanel } from "../text/index.ts";

export function DrawerPart({ drawer }: { drawer: Drawer }) {
    const code = useView((state) => state.code);
    switch (drawer) {
        case "graph":
            return <GraphPanel />;
        case "text":
            return <TextPanel />;
        case "code":
            return code && <CodePanel place={code} />;
    }
}
