/* SPDX-License-Identifier: MIT */
/* What a right click offers for the selected nodes, in the tree and in the picture. In the picture
 * it opens before it is known what was clicked: until then only acts that need no node can run. */

import { nameAll } from "../../model/edits.ts";
import { ActItem } from "../layout/Act.tsx";
import { keyText } from "../layout/keys.ts";
import { useDocument, useView } from "../state.ts";
import { t } from "../texts.ts";
import { MenuItem, MenuLine, type MenuPlace, MenuTitle, PointMenu } from "../widgets/Menu.tsx";

/* What the menu is about: the selected nodes, nothing, or what is still being asked for. */
export type Target = "selection" | "nothing" | "asked";

interface Props {
    at: MenuPlace | null;
    target?: Target;
    /* Tells all that is at the point. */
    onList?: () => void;
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
    [
        "primitive.make",
        "model.make",
        "model.parameters",
        "model.edit",
        "model.unpack",
        "library.save",
    ],
    ["node.up", "node.down", "node.park", "node.unpark"],
    ["node.hide", "node.isolate", "node.showAll", "camera.frame"],
    ["node.delete"],
];

/* What needs no node. */
const always: readonly (readonly string[])[] = [
    ["node.add", "node.paste", "select.all"],
    ["node.showAll", "camera.home"],
];

const TITLES = { asked: "scene.menuAsked", nothing: "scene.menuNothing" } as const;

export function NodeMenu({ at, target = "selection", onList, onClose }: Props) {
    const selection = useView((view) => view.selection);
    const name = useDocument(({ document }) => (document ? nameAll(document, selection) : ""));
    const title = target === "selection" ? name : t(TITLES[target]);
    const shown = target === "selection" ? parts : always;
    return (
        <PointMenu at={at} label={t("scene.menu", { name: title })} onClose={onClose}>
            {at !== null && <MenuTitle>{title}</MenuTitle>}
            {onList && (
                <MenuItem keys={keyText("Alt+Click")} onSelect={onList}>
                    {t("under.open")}
                </MenuItem>
            )}
            {at !== null &&
                shown.map((ids, i) => (
                    <div key={ids[0]}>
                        {i > 0 && <MenuLine />}
                        {ids.map((id) => (
                            <ActItem key={id} id={id} onlyIfAble danger={id === "node.delete"} />
                        ))}
                    </div>
                ))}
        </PointMenu>
    );
}
