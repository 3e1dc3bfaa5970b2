/* SPDX-License-Identifier: MIT */
/* The tree of nodes: rows that can be picked, folded, dragged, renamed, by pointer and by keys. */
import {
    type DragTarget,
    dragAndDropFeature,
    hotkeysCoreFeature,
    type ItemInstance,
    keyboardDragAndDropFeature,
    selectionFeature,
    syncDataLoaderFeature,
    type TreeInstance,
} from "@headless-tree/core";
import { AssistiveTreeDescription, useTree } from "@headless-tree/react";
import { useVirtualizer } from "@tanstack/react-virtual";
import { useEffect, useMemo, useRef, useState } from "react";
import { perform } from "../../model/actions.ts";
import { isInside, nodeLabel, pathTo, type SceneDocument } from "../../model/document.ts";
import { moveNodes } from "../../model/edits.ts";
import { fits } from "../../model/moves.ts";
import { isContainer } from "../../model/placing.ts";
import { nodeType } from "../../model/schema.ts";
import { unfoldTo } from "../../model/view.ts";
import { useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { useMedia } from "../theme.ts";
import { filterNodes } from "./filter.ts";
import { NodeMenu } from "./NodeMenu.tsx";
import { ModelsRow, Row } from "./Row.tsx";
import { selectTo, setAnchor, type TreeItem } from "./range.ts";
import "./scene.css";

/* The tree's own root is not shown; it holds the scene's root node and, where there are models,
 * their heading, which holds their roots. Neither is a node. */
const TOP = "/";
const MODELS = "/models";
const INDENT = 14;
/* Frames that a new row may take. */
const FRAMES = 60;
const ROW = 26;
const TOUCH_ROW = 36;
/* Around all rows. */
const ABOVE = 2;
const BELOW = 26;

export function Tree({ document, query }: { document: SceneDocument; query: string }) {
    const editor = useEditor();
    const { view } = editor.stores;
    const selection = useView((state) => state.selection);
    const collapsed = useView((state) => state.collapsed);
    const [menu, setMenu] = useState<{ x: number; y: number } | null>(null);
    const kept = useMemo(() => filterNodes(document, query), [document, query]);
    const childrenOf = (id: string): string[] => {
        const ids = childIds(document, id);
        return kept === null
            ? ids
            : ids.filter((child) => kept.has(child) || (child === MODELS && anyModel));
    };
    const anyModel = kept === null || document.models.some((model) => kept.has(model.root));
    const expanded = useExpanded(document, collapsed, kept);

    const tree = useTree<TreeItem>({
        rootItemId: TOP,
        features: [
            syncDataLoaderFeature,
            selectionFeature,
            hotkeysCoreFeature,
            dragAndDropFeature,
            keyboardDragAndDropFeature,
        ],
        indent: INDENT,
        canReorder: kept === null,
        dataLoader: {
            getItem: (id) => ({ node: document.nodes.get(id) ?? null }),
            getChildren: childrenOf,
        },
        getItemName: (item) => labelOf(document, item),
        isItemFolder: (item) => childrenOf(item.getId()).length > 0 || mayHold(editor, item),
        state: { expandedItems: expanded, selectedItems: [...selection] },
        setExpandedItems: (update) => {
            const next = new Set(typeof update === "function" ? update(expanded) : update);
            const folded = expanded.filter((id) => !next.has(id));
            view.setState((old) => ({
                collapsed: new Set(
                    [...old.collapsed, ...folded].filter((id) => !next.has(id) && id !== TOP),
                ),
            }));
        },
        setSelectedItems: (update) => {
            const old = [...view.getState().selection];
            const next = typeof update === "function" ? update(old) : update;
            const nodes = next.filter((id) => document.nodes.has(id));
            view.setState({ selection: nodes, subject: { kind: "nodes" } });
        },
        hotkeys: HOTKEYS,
        canDrag: (items) => items.every((item) => item.getItemData().node?.parent != null),
        canDrop: (items, target) => canDrop(editor, document, items, target),
        onDrop: (items, target) => drop(editor, items, target),
    });
    /* The data loader's answers are cached until the tree is told. */
    // biome-ignore lint/correctness/useExhaustiveDependencies: rebuilt when what it shows changes
    useEffect(() => {
        tree.rebuildTree();
    }, [document, kept, collapsed]);
    const bounds = useRef<HTMLDivElement>(null);
    const height = useMedia("(pointer: coarse)") ? TOUCH_ROW : ROW;
    const items = tree
        .getItems()
        .filter((item) => document.nodes.has(item.getId()) || item.getId() === MODELS);
    const rows = useVirtualizer({
        count: items.length,
        getScrollElement: () => bounds.current,
        estimateSize: () => height,
        getItemKey: (index) => items[index]?.getId() ?? index,
        overscan: 8,
        paddingStart: ABOVE,
    });
    useReveal(tree, document, selection.at(-1) ?? null, (id) => {
        const index = items.findIndex((item) => item.getId() === id);
        if (index >= 0) {
            rows.scrollToIndex(index, { align: "auto" });
        }
    });

    return (
        <div className="panel-scroll" ref={bounds}>
            <AssistiveTreeDescription tree={tree} className="unseen" />
            {/* biome-ignore lint/a11y/noStaticElementInteractions: getContainerProps makes it a tree */}
            <div
                {...tree.getContainerProps(t("scene.tree"))}
                onFocus={focusBack(tree, selection.at(-1))}
                className="tree"
                data-testid="tree"
                style={{ blockSize: rows.getTotalSize() + BELOW }}
                data-carries={tree.getState().dnd ? "" : undefined}
            >
                {rows.getVirtualItems().map((row) => {
                    const item = items[row.index];
                    const place = { top: row.start, height };
                    if (item?.getId() === MODELS) {
                        const count = document.models.length;
                        return <ModelsRow key={row.key} item={item} count={count} {...place} />;
                    }
                    return (
                        item && (
                            <Row
                                key={row.key}
                                item={item}
                                node={document.nodes.get(item.getId())}
                                {...place}
                                indent={INDENT}
                                onMenu={setMenu}
                            />
                        )
                    );
                })}
                <div className="tree-line" style={tree.getDragLineStyle()} />
            </div>
            {kept !== null && items.length === 0 && (
                <p className="empty-note">{t("scene.nothing")}</p>
            )}
            <NodeMenu at={menu} onClose={() => setMenu(null)} />
        </div>
    );
}

type Item = ItemInstance<TreeItem>;

/* Keys select what they reach, with Shift up to it; while a row is carried, arrows move it instead. */
function reachKey(hotkey: string, reach: (now: Item) => Item | null | undefined) {
    return {
        hotkey,
        canRepeat: true,
        preventDefault: true,
        isEnabled: (tree: TreeInstance<TreeItem>) => !tree.getState().dnd,
        handler: (event: KeyboardEvent, tree: TreeInstance<TreeItem>) => {
            const reached = reach(tree.getFocusedItem());
            if (reached) {
                select(tree, reached, event.shiftKey);
            }
        },
    };
}

const below = (now: Item): Item => now.getItemBelow() ?? now;
const above = (now: Item): Item => now.getItemAbove() ?? now;

/* Null: it unfolds what is there. */
function inside(now: Item): Item | null {
    if (now.isExpanded() || !now.isFolder()) {
        return below(now);
    }
    now.expand();
    return null;
}

/* Null: it folds what is there. */
function outside(now: Item): Item | null | undefined {
    if ((!now.isExpanded() || !now.isFolder()) && now.getItemMeta().level !== 0) {
        return now.getParent();
    }
    now.collapse();
    return null;
}

/* Of the tree's own keys, those that do something else here. */
const HOTKEYS = {
    focusNextItem: reachKey("ArrowDown", below),
    focusPreviousItem: reachKey("ArrowUp", above),
    selectDownwards: reachKey("Shift+ArrowDown", below),
    selectUpwards: reachKey("Shift+ArrowUp", above),
    expandOrDown: reachKey("ArrowRight", inside),
    collapseOrUp: reachKey("ArrowLeft", outside),
    focusFirstItem: reachKey("Home", (now) => now.getTree().getItems()[0]),
    focusLastItem: reachKey("End", (now) => now.getTree().getItems().at(-1)),
};

function select(tree: TreeInstance<TreeItem>, item: Item, range: boolean): void {
    const id = item.getId();
    item.setFocused();
    tree.updateDomFocus();
    if (range) {
        selectTo(tree, id);
    } else {
        tree.setSelectedItems([id]);
        setAnchor(tree, id);
    }
}

/* The rows that are open; where rows are searched, all that lead to one. */
function useExpanded(
    document: SceneDocument,
    collapsed: ReadonlySet<string>,
    kept: ReadonlySet<string> | null,
): string[] {
    return useMemo(() => {
        const open = [...document.nodes.values()].filter(
            (node) => node.children.length > 0 && (kept !== null || !collapsed.has(node.id)),
        );
        const models = kept !== null || !collapsed.has(MODELS) ? [MODELS] : [];
        return [TOP, ...models, ...open.map((node) => node.id)];
    }, [document, collapsed, kept]);
}

function labelOf(document: SceneDocument, item: Item): string {
    const { node } = item.getItemData();
    const model = document.models.find(({ root }) => root === node?.id);
    return node ? (model?.name ?? nodeLabel(node)) : t("models.trees");
}

/* What a row of the tree has below it. */
function childIds(document: SceneDocument, id: string): string[] {
    if (id === TOP) {
        return document.models.length > 0 ? [document.root, MODELS] : [document.root];
    }
    return id === MODELS
        ? document.models.map((model) => model.root)
        : [...(document.nodes.get(id)?.children ?? [])];
}

function mayHold(editor: ReturnType<typeof useEditor>, item: Item): boolean {
    const { schema } = editor.stores.document.getState();
    const row = nodeType(schema, item.getItemData().node?.type ?? "");
    return row !== null && isContainer(row);
}

function canDrop(
    editor: ReturnType<typeof useEditor>,
    document: SceneDocument,
    items: Item[],
    target: DragTarget<TreeItem>,
): boolean {
    const { schema } = editor.stores.document.getState();
    const ids = items.map((item) => item.getId());
    return fits(schema, document, ids, target.item.getId());
}

function drop(
    editor: ReturnType<typeof useEditor>,
    items: Item[],
    target: DragTarget<TreeItem>,
): void {
    const { document } = editor.stores.document.getState();
    if (document === null) {
        return;
    }
    const into = target.item.getId();
    const ids = items.map((item) => item.getId());
    const others = (document.nodes.get(into)?.children ?? []).filter((id) => !ids.includes(id));
    const before = "insertionIndex" in target ? (others[target.insertionIndex] ?? null) : null;
    perform(editor, moveNodes(document, ids, { into, before }));
}

/* Unfolds the way to a node that was selected elsewhere, focuses its row and brings it in sight. */
function useReveal(
    tree: TreeInstance<TreeItem>,
    scene: SceneDocument,
    id: string | null,
    scroll: (id: string) => void,
): void {
    const { view } = useEditor().stores;
    const revealed = useRef<string | null>(null);
    useEffect(() => {
        /* A node that goes to another parent has another row. */
        const row = id === null ? null : `${scene.nodes.get(id)?.parent}/${id}`;
        if (id === null || row === revealed.current || !scene.nodes.has(id)) {
            revealed.current = id === null ? null : revealed.current;
            return;
        }
        const { collapsed } = view.getState();
        const above = pathTo(scene, id).map((node) => node.id);
        above.pop();
        if (scene.models.some((model) => isInside(scene, id, model.root))) {
            above.push(MODELS);
        }
        if (above.some((one) => collapsed.has(one))) {
            view.setState((state) => unfoldTo(state, above));
            return;
        }
        revealed.current = row;
        tree.getItemInstance(id)?.setFocused();
        scroll(id);
        /* The row of a node that has just come is drawn in one of the next frames. */
        const focus = (frames: number): void => {
            const there = tree.getItemInstance(id)?.getElement()?.isConnected === true;
            if (there || frames === 0) {
                focusRow(tree, id);
            } else if (view.getState().selection.at(-1) === id) {
                requestAnimationFrame(() => focus(frames - 1));
            }
        };
        requestAnimationFrame(() => focus(FRAMES));
    });
}

/* A focus that comes back to the tree, as from a palette, goes to what is selected. */
function focusBack(tree: TreeInstance<TreeItem>, active: string | undefined) {
    return ({ target, currentTarget, relatedTarget }: React.FocusEvent<HTMLElement>): void => {
        const pressed = target.matches(":active");
        const other = target.dataset.node !== active && !pressed;
        if (active !== undefined && other && !currentTarget.contains(relatedTarget)) {
            focusRow(tree, active);
        }
    };
}

/* Moves the focus along with the selection, unless it is somewhere else, or in a name. */
function focusRow(tree: TreeInstance<TreeItem>, id: string): void {
    const active = document.activeElement;
    const lost = active === null || active === document.body;
    if (lost || active.matches("[role='treeitem']")) {
        tree.getItemInstance(id)?.getElement()?.focus({ preventScroll: true });
    }
}
