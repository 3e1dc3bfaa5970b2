/* SPDX-License-Identifier: MIT */
/* What is at a point of the picture: the shapes from front to back, also those that cut, and the nodes
 * above the nearest, from its parent to the root. Each can be selected. */
import { nodeLabel, pathTo, type SceneDocument, type SceneNode } from "../../model/document.ts";
import { effectOf } from "../../model/under.ts";
import { selectNode } from "../insertions.ts";
import { typeTitle } from "../names.ts";
import { useDocument, useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { Glyph } from "../widgets/Glyph.tsx";
import { MenuItem, MenuLine, MenuNote, MenuTitle, PointMenu } from "../widgets/Menu.tsx";
import { Thumbnail } from "../widgets/Thumbnail.tsx";
import type { Under } from "./pointer.ts";

interface Props {
    under: Under | null;
    onClose: () => void;
}

export default function UnderMenu({ under, onClose }: Props) {
    const { view } = useEditor().stores;
    const document = useDocument((state) => state.document);
    const nodes = (under?.nodes ?? []).flatMap((id) => document?.nodes.get(id) ?? []);
    const [nearest] = nodes;
    const close = (): void => {
        view.setState({ hovered: null });
        onClose();
    };
    return (
        <PointMenu at={under?.at ?? null} label={t("under.title")} onClose={close}>
            {under && <MenuTitle>{t("under.title")}</MenuTitle>}
            {under && !nearest && <MenuNote>{t("under.nothing")}</MenuNote>}
            {document && nodes.map((node) => <Item key={node.id} node={node} in={document} />)}
            {document && nearest && <Above node={nearest} in={document} />}
        </PointMenu>
    );
}

interface ItemProps {
    node: SceneNode;
    in: SceneDocument;
}

function Above({ node, in: document }: ItemProps) {
    const above = pathTo(document, node.id).slice(0, -1).reverse();
    return (
        above.length > 0 && (
            <>
                <MenuLine />
                <MenuTitle>{t("under.above", { name: nodeLabel(node) })}</MenuTitle>
                {above.map((one) => (
                    <Item key={one.id} node={one} in={document} />
                ))}
            </>
        )
    );
}

function Item({ node, in: document }: ItemProps) {
    const editor = useEditor();
    const found = effectOf(document, node.id);
    return (
        <MenuItem
            icon={
                <Thumbnail id={node.id} className="tree-thumbnail">
                    <Glyph type={node.type} size={16} />
                </Thumbnail>
            }
            doc={
                found
                    ? t(`under.${found.effect}`, { name: nodeLabel(found.on) })
                    : typeTitle(node.type)
            }
            onReach={() => editor.stores.view.setState({ hovered: node.id })}
            onSelect={() => selectNode(editor, node.id)}
        >
            {nodeLabel(node)}
        </MenuItem>
    );
}
