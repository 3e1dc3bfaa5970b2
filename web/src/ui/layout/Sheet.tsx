/* SPDX-License-Identifier: MIT */
/* On a phone: the picture above, one sheet below with three heights. */
import { type MouseEvent, type ReactNode, useEffect, useRef, useState } from "react";
import { type Drawer, drawerOf, drawersOf } from "../../model/view.ts";
import { Inspector } from "../inspector/Inspector.tsx";
import { Resources, Setup } from "../scene/Resources.tsx";
import { Scene } from "../scene/Scene.tsx";
import { useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { DrawerPart } from "./DrawerPart.tsx";
import { Region } from "./Region.tsx";
import { Tabs } from "./Tabs.tsx";
import "./layout.css";

type Tab = "scene" | "inspector" | "setup" | Drawer;
const always: readonly Tab[] = ["scene", "inspector", "setup"];

const names = {
    scene: "region.scene",
    inspector: "region.inspector",
    setup: "region.scene",
    graph: "graph.label",
    text: "text.title",
    code: "code.title",
} as const;

const isDrawer = (tab: Tab): tab is Drawer => !always.includes(tab);

const heights = ["64px", "46%", "82%"] as const;

/* Runs when something was selected in the picture: its values are what comes next. */
function usePicked(touched: { readonly current: string }, run: () => void): void {
    const { view } = useEditor().stores;
    const latest = useRef(run);
    latest.current = run;
    useEffect(
        () =>
            view.subscribe((now, before) => {
                const changed = now.selection !== before.selection && now.selection.length > 0;
                if (changed && touched.current === "picture") {
                    latest.current();
                }
            }),
        [view, touched],
    );
}

export function Sheet({ picture }: { picture: ReactNode }) {
    const [tab, setTab] = useState<Tab>("scene");
    const [height, setHeight] = useState(1);
    const from = useRef(0);
    const dragged = useRef(false);
    /* What was touched last. */
    const touched = useRef<"picture" | "sheet">("sheet");
    const code = useView((view) => view.code);
    const drawer = useView(drawerOf);
    const open = useView((view) => drawersOf(view).join(" "));
    const tabs = [...always, ...(open.split(" ").filter(Boolean) as Drawer[])];
    /* What is opened is shown, and what was there before when it is closed. */
    // biome-ignore lint/correctness/useExhaustiveDependencies: other code is shown, too
    useEffect(() => {
        setTab((old) => drawer ?? (always.includes(old) ? old : "inspector"));
        setHeight((now) => (drawer === null ? now : 2));
    }, [drawer, code]);
    usePicked(touched, () => {
        setTab("inspector");
        setHeight((now) => Math.max(1, now));
    });
    const show = (next: Tab): void => {
        setTab(next);
        setHeight((now) => Math.max(1, now));
    };
    const release = (y: number): void => {
        const moved = y - from.current;
        dragged.current = Math.abs(moved) >= 8;
        if (dragged.current) {
            setHeight(Math.min(2, Math.max(0, height + (moved < 0 ? 1 : -1))));
        }
    };
    /* By a key or a tap. One that acts before the click leaves the click to what it moves there. */
    const press = ({ detail }: MouseEvent): void => {
        if (detail === 0 || !dragged.current) {
            setHeight((height + 1) % heights.length);
        }
    };
    return (
        <div className="stack" style={{ gridTemplateRows: `1fr ${heights[height]}` }}>
            <div
                className="sheet-picture"
                onPointerDownCapture={() => {
                    touched.current = "picture";
                }}
            >
                {picture}
            </div>
            <div
                className="sheet"
                data-tall={height === 2 || undefined}
                data-low={height === 0 || undefined}
                onPointerDownCapture={() => {
                    touched.current = "sheet";
                }}
            >
                <button
                    type="button"
                    className="sheet-grip"
                    aria-label={t("region.sheet")}
                    onPointerDown={(event) => {
                        from.current = event.clientY;
                        event.currentTarget.setPointerCapture(event.pointerId);
                    }}
                    onPointerUp={(event) => release(event.clientY)}
                    onClick={press}
                />
                <Tabs
                    tabs={tabs.map((id) => ({ id, title: t(`tab.${id}`) }))}
                    active={tab}
                    panel="sheet-panel"
                    onChange={show}
                />
                <div
                    id="sheet-panel"
                    role="tabpanel"
                    aria-label={t(`tab.${tab}`)}
                    className="sheet-body"
                >
                    <Region
                        name={t(names[tab])}
                        className={tab === "inspector" ? "region values-region" : "region"}
                        context={tab === "scene" || tab === "graph" ? "tree" : "anywhere"}
                    >
                        {tab === "scene" && <Scene />}
                        {tab === "inspector" && <Inspector />}
                        {tab === "setup" && <Resources />}
                        {tab === "setup" && <Setup />}
                        {isDrawer(tab) && <DrawerPart drawer={tab} />}
                    </Region>
                </div>
            </div>
        </div>
    );
}
