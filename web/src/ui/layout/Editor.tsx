/* SPDX-License-Identifier: MIT */
/* The editor's layout: three columns on a wide window, two on a narrower one, a picture with a
 * sheet below it on a phone. */

import { useState } from "react";
import { Group, Panel, Separator, useDefaultLayout } from "react-resizable-panels";
import { type Drawer as DrawerName, drawerOf, drawersOf } from "../../model/view.ts";
import { Inspector } from "../inspector/Inspector.tsx";
import { Resources, Setup } from "../scene/Resources.tsx";
import { Scene } from "../scene/Scene.tsx";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { NARROW, useMedia, WIDE } from "../theme.ts";
import { View } from "../view/View.tsx";
import { Bar } from "./Bar.tsx";
import { DrawerPart } from "./DrawerPart.tsx";
import { Region } from "./Region.tsx";
import { Sheet } from "./Sheet.tsx";
import { Status } from "./Status.tsx";
import { Tabs } from "./Tabs.tsx";
import "./layout.css";

export function EditorPage() {
    const hidden = useView((view) => view.chromeHidden);
    const wide = useMedia(WIDE);
    const narrow = useMedia(NARROW);
    return (
        <div className="editor">
            {hidden ? <span /> : <Bar narrow={narrow} />}
            <main className="middle" aria-label={t("region.editor")}>
                <Heading />
                <Middle hidden={hidden} layout={narrow ? "sheet" : wide ? "columns" : "stack"} />
            </main>
            {hidden || narrow ? <span /> : <Status />}
        </div>
    );
}

/* The page's own heading, which the bar shows as a menu. */
function Heading() {
    const name = useDocument((state) => state.document?.info.name);
    return <h1 className="unseen">{typeof name === "string" ? name : t("bar.untitled")}</h1>;
}

function Middle({ hidden, layout }: { hidden: boolean; layout: "columns" | "stack" | "sheet" }) {
    const picture = (
        <Region name={t("region.view")} context="view">
            <View />
        </Region>
    );
    if (hidden) {
        return picture;
    }
    if (layout === "sheet") {
        return <Sheet picture={picture} />;
    }
    return layout === "columns" ? <Columns /> : <Stack />;
}

/* The picture, and below it the graph or the code that is being written, if any. */
function Picture() {
    const drawer = useView(drawerOf);
    const saved = useDefaultLayout({
        id: "picture-drawer",
        panelIds: drawer === null ? ["panel-picture"] : ["panel-picture", `panel-${drawer}`],
        storage: localStorage,
    });
    return (
        <Group id="picture-drawer" orientation="vertical" {...saved}>
            <Panel id="panel-picture" minSize={120}>
                <Region name={t("region.view")} context="view">
                    <View />
                </Region>
            </Panel>
            {drawer !== null && (
                <Separator className="separator" aria-label={t("region.resizeDrawer")} />
            )}
            {drawer !== null && (
                <Panel id={`panel-${drawer}`} key={drawer} minSize={140} defaultSize="46%">
                    <Drawer drawer={drawer} />
                </Panel>
            )}
        </Group>
    );
}

/* Tabs where several are open. */
function Drawer({ drawer }: { drawer: DrawerName }) {
    const { view } = useEditor().stores;
    const open = useView((state) => drawersOf(state).join(" ")).split(" ") as DrawerName[];
    if (open.length < 2) {
        return <DrawerPart drawer={drawer} />;
    }
    return (
        <div className="drawer">
            <Tabs
                tabs={open.map((id) => ({ id, title: t(`tab.${id}`) }))}
                active={drawer}
                panel="drawer-panel"
                onChange={(id) => view.setState({ drawer: id })}
            />
            <div
                id="drawer-panel"
                role="tabpanel"
                className="tab-panel"
                aria-label={t(`tab.${drawer}`)}
            >
                <DrawerPart drawer={drawer} />
            </div>
        </div>
    );
}

function SceneRegion() {
    const saved = useDefaultLayout({ id: "scene-split", storage: localStorage });
    return (
        <Region name={t("region.scene")} context="tree">
            <Group id="scene-split" orientation="vertical" className="split" {...saved}>
                <Panel id="panel-tree" minSize={110} defaultSize="58%">
                    <Scene />
                </Panel>
                <Separator className="separator" aria-label={t("region.resizeTree")} />
                <Panel id="panel-resources" minSize={64}>
                    <Resources />
                </Panel>
            </Group>
            <Setup />
        </Region>
    );
}

const parts = ["scene", "setup"] as const;

/* Where height is short: the tree and the lists in turns. */
function SceneTabs() {
    const [part, setPart] = useState<(typeof parts)[number]>("scene");
    return (
        <Region name={t("region.scene")} context="tree">
            <Tabs
                tabs={parts.map((id) => ({ id, title: t(`tab.${id}`) }))}
                active={part}
                panel="scene-panel"
                onChange={setPart}
            />
            <div
                id="scene-panel"
                role="tabpanel"
                className="tab-panel"
                aria-label={t(`tab.${part}`)}
            >
                {part === "scene" ? <Scene /> : <Resources />}
            </div>
            <Setup />
        </Region>
    );
}

function InspectorRegion() {
    return (
        <Region name={t("region.inspector")} className="region values-region">
            <Inspector />
        </Region>
    );
}

function Columns() {
    const saved = useDefaultLayout({ id: "columns", storage: localStorage });
    return (
        <Group id="columns" orientation="horizontal" {...saved}>
            <Panel
                id="panel-scene"
                defaultSize={264}
                minSize={200}
                maxSize={480}
                groupResizeBehavior="preserve-pixel-size"
            >
                <SceneRegion />
            </Panel>
            <Separator className="separator" aria-label={t("region.resizeScene")} />
            <Panel id="panel-view" minSize={320}>
                <Picture />
            </Panel>
            <Separator className="separator" aria-label={t("region.resizeInspector")} />
            <Panel
                id="panel-inspector"
                defaultSize={312}
                minSize={260}
                maxSize={520}
                groupResizeBehavior="preserve-pixel-size"
            >
                <InspectorRegion />
            </Panel>
        </Group>
    );
}

function Stack() {
    const saved = useDefaultLayout({ id: "stack", storage: localStorage });
    const inner = useDefaultLayout({ id: "stack-inner", storage: localStorage });
    return (
        <Group id="stack" orientation="horizontal" {...saved}>
            <Panel id="panel-view" minSize={280}>
                <Picture />
            </Panel>
            <Separator className="separator" aria-label={t("region.resizeInspector")} />
            <Panel
                id="panel-side"
                defaultSize={320}
                minSize={260}
                maxSize={460}
                groupResizeBehavior="preserve-pixel-size"
            >
                <Group id="stack-inner" orientation="vertical" {...inner}>
                    <Panel id="panel-scene" minSize={140} defaultSize="50%">
                        <SceneTabs />
                    </Panel>
                    <Separator className="separator" aria-label={t("region.resizeStack")} />
                    <Panel id="panel-inspector" minSize={140}>
                        <InspectorRegion />
                    </Panel>
                </Group>
            </Panel>
        </Group>
    );
}
