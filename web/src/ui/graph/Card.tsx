/* SPDX-License-Identifier: MIT */
/* A node as a card: its inputs on the left, its result on the right, its picture and its two main
 * values between them. */
import type { Node, NodeProps } from "@xyflow/react";
import { ChevronsLeft, ChevronsRight, Eye, EyeOff, Focus } from "lucide-react";
import { memo, type ReactNode, useEffect, useLayoutEffect, useRef, useState } from "react";
import { isShown, isVisible, nodeLabel, parentOf } from "../../model/document.ts";
import { setVisible } from "../../model/edits.ts";
import { type Card, inputY, neighbour, resultOf, roomForPicture } from "../../model/graph.ts";
import { nodeType } from "../../model/schema.ts";
import { select } from "../../model/view.ts";
import { Form } from "../form.tsx";
import { takesMaterial } from "../materials/drag.ts";
import { typeTitle } from "../names.ts";
import { TypePicture } from "../palettes/TypePicture.tsx";
import { ProblemMark } from "../scene/ProblemMark.tsx";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Glyph } from "../widgets/Glyph.tsx";
import { Thumbnail } from "../widgets/Thumbnail.tsx";
import { useShared } from "./context.ts";
import { useFar, useStop } from "./sight.ts";

export type CardNode = Node<{ card: Card }, "card">;

export function GraphCard({ data: { card } }: NodeProps<CardNode>) {
    return <CardBody card={card} />;
}

const CardBody = memo(function CardBody({ card }: { card: Card }) {
    const type = useDocument(({ document }) => document?.nodes.get(card.id)?.type ?? "");
    return type === "" ? null /* removed; the graph follows */ : <Shown card={card} type={type} />;
});

function Shown({ card, type }: { card: Card; type: string }) {
    const { id } = card;
    const far = useFar();
    const element = useRef<HTMLDivElement>(null);
    const group = useDocument(({ schema }) => nodeType(schema, type)?.group);
    const name = useName(id);
    const label = useLabel(card, name, type);
    const shown = useDocument(({ document }) => document === null || isShown(document, id));
    const selected = useView((view) => view.selection.includes(id));
    const hovered = useView((view) => view.hovered === id);
    useFocus(element, id);
    const acts = useActs(card);
    const tabIndex = useTabIndex(id);
    return (
        // biome-ignore lint/a11y/useSemanticElements: a fieldset brings a look of its own
        <div
            ref={element}
            role="group"
            aria-label={label}
            aria-describedby="graph-help"
            aria-current={selected || undefined}
            tabIndex={tabIndex}
            className="graph-card"
            data-grab="card"
            data-card={id}
            data-type={type}
            data-selected={selected || undefined}
            data-hovered={hovered || undefined}
            data-hidden={shown ? undefined : ""}
            {...acts}
        >
            <header className="graph-card-head">
                <Glyph type={type} group={group} size={far > 1 ? 26 : 16} />
                <span className="graph-card-name ellipsis">{name}</span>
                <ProblemMark id={id} />
                {far === 0 && <CardButtons card={card} name={name} />}
            </header>
            <div className="graph-card-body">
                <Picture id={id} width={far === 0 ? roomForPicture(card) : null}>
                    <TypePicture type={type} group={group} size={34} />
                </Picture>
                {far === 0 && <Values card={card} name={name} />}
            </div>
            <Ports card={card} name={name} />
        </div>
    );
}

interface PictureProps {
    id: string;
    /* Null: of a card that has no room for a large one. */
    width: number | null;
    children: ReactNode;
}

function usePictured(id: string): string {
    const results = useView((view) => view.preferences.results);
    return useDocument(({ document, schema }) =>
        results && document ? resultOf(document, schema, id) : id,
    );
}

/* The result so far; larger while the pointer is on it, or where nothing else is on the card. */
function Picture({ id: own, width, children }: PictureProps) {
    const id = usePictured(own);
    const [large, setLarge] = useState(false);
    if (width !== null) {
        return (
            <span className="graph-card-picture" style={{ inlineSize: width, blockSize: "auto" }}>
                <Thumbnail id={id} large className="graph-card-whole">
                    {children}
                </Thumbnail>
            </span>
        );
    }
    return (
        <span
            className="graph-card-picture"
            onPointerEnter={({ buttons }) => setLarge(buttons === 0)}
            onPointerLeave={() => setLarge(false)}
            onPointerDown={() => setLarge(false)}
        >
            <Thumbnail id={id}>{children}</Thumbnail>
            {large && <Thumbnail id={id} large className="graph-card-large" />}
        </span>
    );
}

const useName = (id: string): string =>
    useDocument(({ document }) => {
        const node = document?.nodes.get(id);
        const model = document?.models.find(({ root }) => root === id);
        return model?.name ?? (node ? nodeLabel(node) : id);
    });

/* What it is and where it goes. */
function useLabel({ id }: Card, name: string, type: string): string {
    const parent = useDocument(({ document }) => {
        const node = document?.nodes.get(id);
        const above = document && node ? parentOf(document, node) : undefined;
        return above ? `${above.children.indexOf(id) + 1} ${nodeLabel(above)}` : null;
    });
    const what = { name, type: typeTitle(type).toLowerCase() };
    if (parent === null) {
        return t("graph.result", what);
    }
    const space = parent.indexOf(" ");
    return t("graph.card", {
        ...what,
        number: parent.slice(0, space),
        parent: parent.slice(space + 1),
    });
}

function useTabIndex(id: string): 0 | -1 {
    const { graph } = useShared();
    return useStop(graph) === id ? 0 : -1;
}

/* The focus goes along with the selection, unless it is somewhere else. A card that goes, as it is
 * deleted or out of sight, leaves it to the panel, for the next one to take. */
function useFocus(element: { readonly current: HTMLElement | null }, id: string): void {
    const active = useView((view) => view.selection.at(-1) === id);
    const { next } = useShared();
    useLayoutEffect(() => {
        const own = element.current;
        if (next.current === id) {
            next.current = null;
            if (document.activeElement?.matches(".graph-panel")) {
                own?.focus({ preventScroll: true });
            }
        }
        return () => {
            if (own?.contains(document.activeElement)) {
                own.closest<HTMLElement>(".graph-panel")?.focus({ preventScroll: true });
            }
        };
    }, [element, id, next]);
    useEffect(() => {
        if (active && document.activeElement?.matches("[data-card], .graph-panel")) {
            element.current?.focus({ preventScroll: true });
        }
    }, [active, element]);
}

/* What pointers and keys do with the card itself, not with what is on it. */
function useActs({ id, hidden, inputs }: Card) {
    const editor = useEditor();
    const { view } = editor.stores;
    const { graph, openMenu } = useShared();
    const pick = (mode: "replace" | "toggle"): void =>
        view.setState(({ selection }) => ({
            selection: select(selection, id, mode),
            subject: { kind: "nodes" },
        }));
    const keep = (): void => {
        if (!view.getState().selection.includes(id)) {
            pick("replace");
        }
    };
    const ofCard = (target: EventTarget): boolean =>
        target instanceof Element && target.closest("button, input, .graph-values") === null;
    return {
        onClick: ({ target, shiftKey, ctrlKey, metaKey }: React.MouseEvent): void => {
            if (ofCard(target)) {
                pick(shiftKey || ctrlKey || metaKey ? "toggle" : "replace");
            }
        },
        onContextMenu: (event: React.MouseEvent): void => {
            event.preventDefault();
            keep();
            openMenu({ x: event.clientX, y: event.clientY });
        },
        ...takesMaterial(editor, id),
        onPointerEnter: (): void => view.setState({ hovered: id }),
        onPointerLeave: (): void => view.setState({ hovered: null }),
        onKeyDown: (event: React.KeyboardEvent<HTMLElement>): void => {
            if (event.target !== event.currentTarget || event.altKey) {
                return;
            }
            const next = neighbour(graph, id, event.key);
            const menu = event.key === "ContextMenu" || (event.shiftKey && event.key === "F10");
            if (next !== null) {
                view.setState({ selection: [next], subject: { kind: "nodes" } });
            } else if (event.key === " " && (hidden > 0 || inputs.length > 0)) {
                view.setState(({ collapsed }) => ({ collapsed: toggled(collapsed, id) }));
            } else if (menu) {
                keep();
                const box = event.currentTarget.getBoundingClientRect();
                openMenu({ x: box.left + 24, y: box.top + 24 });
            } else {
                return;
            }
            event.preventDefault();
            event.stopPropagation();
        },
    };
}

function toggled(set: ReadonlySet<string>, id: string): ReadonlySet<string> {
    const next = new Set(set);
    if (!next.delete(id)) {
        next.add(id);
    }
    return next;
}

function CardButtons({ card: { id, hidden, inputs }, name }: { card: Card; name: string }) {
    const { stores, link } = useEditor();
    const isolated = useView((view) => view.isolated.includes(id));
    const visible = useDocument(({ document }) => {
        const node = document?.nodes.get(id);
        return !node || isVisible(node);
    });
    const mute = (): void => {
        const { document } = stores.document.getState();
        if (document) {
            const edit = setVisible(document, [id], !visible);
            link.edit(edit.ops, { label: edit.label });
        }
    };
    const fold =
        hidden === 0 ? t("graph.fold", { name }) : t("graph.unfold", { name, count: hidden });
    return (
        <span className="graph-card-buttons">
            <CardButton
                title={t(isolated ? "graph.showAll" : "graph.isolate", { name })}
                on={isolated}
                onClick={() => stores.view.setState({ isolated: isolated ? [] : [id] })}
            >
                <Focus size={14} />
            </CardButton>
            <CardButton
                title={t(visible ? "scene.hide" : "scene.show", { name })}
                on={!visible}
                onClick={mute}
            >
                {visible ? <Eye size={14} /> : <EyeOff size={14} />}
            </CardButton>
            {(hidden > 0 || inputs.length > 0) && (
                <CardButton
                    title={fold}
                    on={hidden > 0}
                    onClick={() =>
                        stores.view.setState(({ collapsed }) => ({
                            collapsed: toggled(collapsed, id),
                        }))
                    }
                >
                    {hidden > 0 ? <ChevronsLeft size={14} /> : <ChevronsRight size={14} />}
                </CardButton>
            )}
        </span>
    );
}

interface ButtonProps {
    title: string;
    on: boolean;
    onClick: () => void;
    children: React.ReactNode;
}

/* The card has the focus; Tab goes through its fields and not through these. */
function CardButton({ title, on, onClick, children }: ButtonProps) {
    return (
        <button
            type="button"
            className="graph-button nopan"
            tabIndex={-1}
            aria-label={title}
            title={title}
            data-on={on || undefined}
            onClick={onClick}
        >
            {children}
        </button>
    );
}

function Values({ card: { id, beside, below }, name }: { card: Card; name: string }) {
    const base = `/nodes/${id}/params`;
    return (
        <>
            <div className="graph-values values-region nopan" data-beside="">
                <Form params={beside} base={base} owner={name} />
            </div>
            <div className="graph-values values-region nopan">
                <Form params={below} base={base} owner={name} />
            </div>
        </>
    );
}

/* `data-grab` is what a hand takes there, `data-index` the number of the input. */
function Ports({ card: { inputs, open }, name }: { card: Card; name: string }) {
    return (
        <>
            {inputs.map((input, index) => (
                <span
                    key={input}
                    className="graph-port"
                    style={{ insetBlockStart: inputY(index) }}
                    data-grab="loose"
                    data-index={index}
                    title={t("graph.input", { number: index + 1, name })}
                />
            ))}
            {open && (
                <span
                    className="graph-port"
                    style={{ insetBlockStart: inputY(inputs.length) }}
                    data-grab="free"
                    data-index={inputs.length}
                    title={t("graph.free", { name })}
                />
            )}
            <span
                className="graph-port"
                data-side="result"
                data-grab="output"
                title={t("graph.output", { name })}
            />
        </>
    );
}
