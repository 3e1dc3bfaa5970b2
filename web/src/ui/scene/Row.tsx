/* SPDX-License-Identifier: MIT */
/* One row of the tree. */
import type { ItemInstance } from "@headless-tree/core";
import { ChevronRight, Eye, EyeOff, Focus } from "lucide-react";
import {
    functionOf,
    isApart,
    isShown,
    isVisible,
    modelNamed,
    nodeLabel,
    type SceneNode,
} from "../../model/document.ts";
import { rename, setVisible } from "../../model/edits.ts";
import { nodeType } from "../../model/schema.ts";
import { useNameCut } from "../fields/nameCut.ts";
import { takesMaterial } from "../materials/drag.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Glyph } from "../widgets/Glyph.tsx";
import { Swatch } from "../widgets/Swatch.tsx";
import { Thumbnail } from "../widgets/Thumbnail.tsx";
import { ProblemMark } from "./ProblemMark.tsx";
import { TypeIcon } from "./ResourceIcon.tsx";
import { selectTo, setAnchor, type TreeItem } from "./range.ts";
import "./scene.css";

interface Props {
    item: ItemInstance<TreeItem>;
    node: SceneNode | undefined;
    top: number;
    height: number;
    indent: number;
    onMenu: (at: { x: number; y: number }) => void;
}

export function Row({ item, node, top, height, indent, onMenu }: Props) {
    const editor = useEditor();
    const { stores } = editor;
    const id = item.getId();
    const group = useDocument((state) => nodeType(state.schema, node?.type ?? "")?.group);
    /* The root of a model bears the model's name; an instance says of what. */
    const model = useDocument(({ document }) =>
        node?.parent === null
            ? (document?.models.find(({ root }) => root === id)?.name ?? null)
            : null,
    );
    const of = useDocument(({ document, schema }) =>
        document && node
            ? (modelNamed(schema, document, node)?.name ??
              functionOf(schema, document, node)?.name ??
              null)
            : null,
    );
    const pictured = useView((view) => view.preferences.thumbnails);
    const hovered = useView((view) => view.hovered === id);
    const renaming = useView((view) => view.renaming === id);
    const isolated = useView((view) => view.isolated);
    const apart = useDocument(
        ({ document }) => document !== null && isApart(document, isolated, id),
    );
    const shown = useDocument(({ document }) => document === null || isShown(document, id));
    if (!node) {
        return null;
    }
    const { onClick: _click, ...props } = item.getProps();
    const name = model ?? nodeLabel(node);
    const own = node.common.material;
    const level = item.getItemMeta().level;
    const foldable = node.children.length > 0;
    return (
        // biome-ignore lint/a11y/noStaticElementInteractions: getProps makes it a treeitem
        // biome-ignore lint/a11y/useKeyWithClickEvents: the tree's own keys do it
        // biome-ignore lint/a11y/useAriaPropsSupportedByRole: getProps makes it a treeitem
        <div
            {...props}
            className="tree-row"
            aria-expanded={foldable ? item.isExpanded() : undefined}
            style={{
                insetBlockStart: top,
                blockSize: height,
                paddingInlineStart: level * indent,
                ...({ "--level": level, "--indent": `${indent}px` } as object),
            }}
            data-node={id}
            data-type={node.type}
            data-hidden={shown ? undefined : ""}
            data-hovered={hovered || undefined}
            data-apart={apart || undefined}
            data-isolated={isolated.includes(id) || undefined}
            data-drop={item.isUnorderedDragTarget() ? "inside" : undefined}
            onClick={(event) => {
                stores.view.setState({ subject: { kind: "nodes" } });
                if (event.ctrlKey || event.metaKey) {
                    item.toggleSelect();
                    setAnchor(item.getTree(), id);
                } else if (event.shiftKey) {
                    selectTo(item.getTree(), id);
                } else {
                    item.getTree().setSelectedItems([id]);
                    setAnchor(item.getTree(), id);
                }
                item.setFocused();
                item.getElement()?.focus();
            }}
            /* The place of a drop stays in sight from row to row. */
            onDragLeave={(event) => {
                const to = event.relatedTarget;
                if (!(to instanceof Element && to.closest("[role='tree']"))) {
                    props.onDragLeave?.(event);
                }
            }}
            {...takesMaterial(editor, id, props)}
            onPointerEnter={() => stores.view.setState({ hovered: id })}
            onPointerLeave={() => stores.view.setState({ hovered: null })}
            onDoubleClick={() => model === null && stores.view.setState({ renaming: id })}
            onContextMenu={(event) => {
                event.preventDefault();
                if (!item.isSelected()) {
                    item.getTree().setSelectedItems([id]);
                }
                onMenu({ x: event.clientX, y: event.clientY });
            }}
        >
            <Twist item={item} foldable={foldable} name={name} />
            {model === null ? <Glyph type={node.type} group={group} /> : <TypeIcon list="models" />}
            {renaming ? (
                <Rename node={node} />
            ) : (
                <span className="tree-name ellipsis">
                    {name}
                    {of !== null && of !== name && <span className="tree-of">{of}</span>}
                </span>
            )}
            <ProblemMark id={id} />
            {typeof own === "string" && own !== "" && <Swatch name={own} className="tree-swatch" />}
            {isolated.includes(id) && <IsolatedMark />}
            {pictured && <Thumbnail id={id} className="tree-thumbnail" />}
            <EyeButton node={node} name={name} />
        </div>
    );
}

function IsolatedMark() {
    const title = t("scene.isolated");
    return (
        <span className="tree-isolated" role="img" title={title} aria-label={title}>
            <Focus size={14} />
        </span>
    );
}

interface ModelsProps {
    item: Props["item"];
    count: number;
    top: number;
    height: number;
}

/* The heading above the roots of the models. */
export function ModelsRow({ item, count, top, height }: ModelsProps) {
    const title = t("models.trees");
    const { onClick: _click, ...props } = item.getProps();
    const fold = (): void => (item.isExpanded() ? item.collapse() : item.expand());
    return (
        // biome-ignore lint/a11y/noStaticElementInteractions: getProps makes it a treeitem
        // biome-ignore lint/a11y/useKeyWithClickEvents: the tree's own keys do it
        <div
            {...props}
            className="tree-row tree-heading"
            style={{ insetBlockStart: top, blockSize: height }}
            data-heading="models"
            onClick={fold}
        >
            <Twist item={item} foldable={true} name={title} />
            <span className="tree-name">
                {title} <span className="section-count">{count}</span>
            </span>
        </div>
    );
}

function Twist({ item, foldable, name }: { item: Props["item"]; foldable: boolean; name: string }) {
    if (!foldable) {
        return <span className="tree-twist" />;
    }
    return (
        <button
            type="button"
            className="tree-twist"
            tabIndex={-1}
            aria-label={t("scene.expand", { name })}
            onClick={(event) => {
                event.stopPropagation();
                if (item.isExpanded()) {
                    item.collapse();
                } else {
                    item.expand();
                }
            }}
        >
            <ChevronRight size={13} />
        </button>
    );
}

function EyeButton({ node, name }: { node: SceneNode; name: string }) {
    const { stores, link } = useEditor();
    const visible = isVisible(node);
    const title = t(visible ? "scene.hide" : "scene.show", { name });
    return (
        <button
            type="button"
            className="tree-eye"
            tabIndex={-1}
            data-off={visible ? undefined : ""}
            aria-label={title}
            title={title}
            onDoubleClick={(event) => event.stopPropagation()}
            onClick={(event) => {
                event.stopPropagation();
                const { document } = stores.document.getState();
                if (document) {
                    const edit = setVisible(document, [node.id], !visible);
                    link.edit(edit.ops, { label: edit.label });
                }
            }}
        >
            {visible ? <Eye size={14} /> : <EyeOff size={14} />}
        </button>
    );
}

function Rename({ node }: { node: SceneNode }) {
    const { stores, link } = useEditor();
    const cut = useNameCut();
    const name = nodeLabel(node);
    const finish = (text: string | null, element: HTMLElement): void => {
        const row = element.closest<HTMLElement>("[role='treeitem']");
        if (stores.view.getState().renaming !== node.id) {
            return;
        }
        stores.view.setState({ renaming: null });
        const { document } = stores.document.getState();
        if (document && text !== null && text !== name) {
            const edit = rename(document, node.id, text);
            link.edit(edit.ops, { label: edit.label });
        }
        row?.focus();
    };
    return (
        <input
            className="tree-rename"
            aria-label={t("scene.rename", { name })}
            // biome-ignore lint/a11y/noAutofocus: the user has just asked to type here
            autoFocus
            defaultValue={name}
            onInput={(event) => cut(event.currentTarget)}
            onFocus={(event) => event.currentTarget.select()}
            onClick={(event) => event.stopPropagation()}
            onDoubleClick={(event) => event.stopPropagation()}
            onBlur={(event) => finish(event.currentTarget.value, event.currentTarget)}
            onKeyDown={(event) => {
                event.stopPropagation();
                if (event.key === "Enter") {
                    finish(event.currentTarget.value, event.currentTarget);
                } else if (event.key === "Escape") {
                    finish(null, event.currentTarget);
                }
            }}
        />
    );
}
