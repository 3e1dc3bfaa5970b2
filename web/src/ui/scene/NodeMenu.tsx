/* SPDX-License-Identifier: MIT */
/* What a right click offers for the selected nodes, in the tree and in the picture. */

import { nodeLabel } from "../../model/document.ts";
import { ActItem } from "../frame/Act.tsx";
import { MenuLine, PointMenu } from "../parts/Menu.tsx";
import { useDocument, useView } from "../state.ts";
import { t } from "../texts.ts";

interface Props {
    at: { x: number; y: number } | null;
    onClose: () => void;
}

const parts: readonly (readonly string[])[] = [
    ["node.add", "node.rename", "node.duplicate", "node.copy", "node.cut", "node.paste"],
    [
        "node.group",
        "node.wrap.union",
        "node.wrap.difference",
        "node.wrap.smooth_union",
        "node.wrap",
        "node.dissolve",
    ],
    ["model.edit", "model.make", "model.unpack"],
    ["node.up", "node.down", "node.hide", "node.hideOthers", "node.showAll", "camera.frame"],
];

export function NodeMenu({ at, onClose }: Props) {
    const active = useView((view) => view.selection.at(-1) ?? "");
    const name = useDocument((state) => {
        const node = state.document?.nodes.get(active);
        return node ? nodeLabel(node) : "";
    });
    return (
        <PointMenu at={at} label={t("scene.menu", { name })} onClose={onClose}>
            {at !== null &&
                parts.map((ids) => (
                    <div key={ids[0]}>
                        {ids.map((id) => (
                            <ActItem key={id} id={id} onlyIfAble />
                        ))}
                        <MenuLine />
                    </div>
                ))}
            {at !== null && <ActItem id="node.delete" danger onlyIfAble />}
        </PointMenu>
    );
}
