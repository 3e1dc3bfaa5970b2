/* SPDX-License-Identifier: MIT */
/* The picture's place: the link shows frames in it, the input turns pointers into camera moves and
 * picks; React draws only what lies over it. */
import { Eye } from "lucide-react";
import { useCallback, useEffect, useRef, useState } from "react";
import { Grid } from "../../overlay/grid.ts";
import type { Hands } from "../../overlay/hands.ts";
import { Outlines } from "../../overlay/outlines.ts";
import { attachPointer, type PointerActions } from "../../overlay/pointer.ts";
import type { Editor } from "../editor.ts";
import { lazyPart } from "../lazy.tsx";
import { NodeMenu, type Target } from "../scene/NodeMenu.tsx";
import { useDocument, useEditor, useLink, useView } from "../state.ts";
import { t } from "../texts.ts";
import { TOUCH, useMedia } from "../theme.ts";
import { Button } from "../widgets/Button.tsx";
import type { MenuPlace } from "../widgets/Menu.tsx";
import { AxesBall } from "./AxesBall.tsx";
import { Crumbs } from "./Crumbs.tsx";
import { HandTools } from "./HandTools.tsx";
import { watchHover } from "./hover.ts";
import { Isolation } from "./Isolation.tsx";
import { takeMaterials } from "./materials.ts";
import { Outputs } from "./Outputs.tsx";
import { Poster } from "./Poster.tsx";
import { handsPage, pointerActions, type Under } from "./pointer.ts";
import { BrokenPill, SoftwareChip, StatePill } from "./State.tsx";
import { Strip } from "./Strip.tsx";
import "./view.css";

const Drops = lazyPart(() => import("../drop/Drops.tsx"));
const UnderMenu = lazyPart(() => import("./UnderMenu.tsx"));
const Marks = lazyPart(() => import("./Marks.tsx"));
const Measured = lazyPart(() => import("./Measure.tsx"));
const MeasuredLine = lazyPart(() => import("./MeasuredLine.tsx"));
const Section = lazyPart(() => import("./Section.tsx"));
const SectionHandle = lazyPart(() => import("./SectionHandle.tsx"));
const StatisticsPill = lazyPart(() => import("./Statistics.tsx"));
const Trial = lazyPart(() => import("./Trial.tsx"));

export function View() {
    return (
        <div className="view">
            <Picture />
            <Poster />
            <Trial />
            <Marks />
            <MeasuredLine />
            <Empty />
            <Strip />
            <div className="view-top">
                <Crumbs />
                <span className="view-space" />
                <HandTools />
                <Outputs />
            </div>
            <AxesBall />
            <Drops />
            <div className="view-bottom">
                <Aim />
                <Measured />
                <Section />
                <Isolation />
                <Hint />
                <div className="view-pills">
                    <StatePill />
                    <BrokenPill />
                    <StatisticsPill />
                    <SoftwareChip />
                    <Panels />
                </div>
            </div>
        </div>
    );
}

/* They are there a moment after the picture: the first sight of it needs none. */
function handsIn(editor: Editor, element: HTMLElement) {
    let hands: Hands | null = null;
    let ended = false;
    void import("../../overlay/hands.ts").then((overlay) => {
        hands = ended ? null : new overlay.Hands(handsPage(editor), element);
    });
    return {
        get: () => hands,
        end: () => {
            ended = true;
            hands?.end();
        },
    };
}

function Picture() {
    const editor = useEditor();
    const place = useRef<HTMLDivElement>(null);
    const aiming = useView((view) => view.aiming || view.measured !== null);
    const empty = useLink(({ frame }) => frame.state === "none");
    const { menu, open, close } = usePictureMenu();
    const [under, setUnder] = useState<Under | null>(null);
    const [acts, setActs] = useState<PointerActions | null>(null);
    const list = useRef<(at: MenuPlace) => void>(undefined);
    useEffect(() => {
        const element = place.current;
        if (element === null) {
            return;
        }
        editor.setPicture(element);
        const hide = editor.link.attach(element);
        const grid = new Grid(editor.stores, element);
        const outlines = new Outlines(editor.stores, element, editor.bounds);
        const hands = handsIn(editor, element);
        const actions = pointerActions(editor, element, hands.get, open, setUnder);
        setActs(actions);
        list.current = ({ x, y }) => {
            const box = element.getBoundingClientRect();
            actions.click(x - box.left, y - box.top, "replace", true);
        };
        const stop = attachPointer(element, actions);
        const rest = watchHover(editor, element);
        const drops = takeMaterials(editor, element);
        return () => {
            drops();
            rest();
            stop();
            hands.end();
            outlines.end();
            grid.end();
            hide();
            editor.setPicture(null);
        };
    }, [editor, open]);
    return (
        <>
            <div
                ref={place}
                className="view-picture"
                data-testid="picture"
                data-aiming={aiming || undefined}
                data-empty={empty || undefined}
                data-region-focus=""
                role="application"
                aria-label={t("view.picture")}
                aria-describedby="view-help"
                // biome-ignore lint/a11y/noNoninteractiveTabindex: arrow keys look around in it
                tabIndex={0}
            />
            <p id="view-help" className="unseen">
                {t("view.help")}
            </p>
            <NodeMenu
                at={menu}
                target={menu?.target}
                onList={() => menu && list.current?.(menu)}
                onClose={close}
            />
            <UnderMenu under={under} onClose={() => setUnder(null)} />
            {acts && <SectionHandle actions={acts} />}
        </>
    );
}

interface PictureMenu extends MenuPlace {
    target: Target;
}

/* The menu at the pointer. What `open` answers says what was found there; after the menu was closed
 * or opened elsewhere it does nothing. */
function usePictureMenu() {
    const [menu, setMenu] = useState<PictureMenu | null>(null);
    const newest = useRef(0);
    const open = useCallback((at: MenuPlace) => {
        newest.current += 1;
        const mine = newest.current;
        setMenu({ ...at, target: "asked" });
        return (settle: () => Target): void => {
            if (newest.current === mine) {
                setMenu({ ...at, target: settle() });
            }
        };
    }, []);
    const close = useCallback(() => {
        newest.current += 1;
        setMenu(null);
    }, []);
    return { menu, open, close };
}

/* What the next click does, when it is not to select. */
function Aim() {
    const aiming = useView((view) => view.aiming);
    const touch = useMedia(TOUCH);
    return (
        <div role="status" className="view-aim">
            {aiming && <p className="glass view-hint">{t(touch ? "view.aimTouch" : "view.aim")}</p>}
        </div>
    );
}

/* The way back to the panels, where there is no keyboard. */
function Panels() {
    const { stores } = useEditor();
    return (
        useView((view) => view.chromeHidden) && (
            <button
                type="button"
                className="glass pill"
                onClick={() => stores.view.setState({ chromeHidden: false })}
            >
                <Eye size={14} aria-hidden="true" />
                {t("view.panels")}
            </button>
        )
    );
}

function Empty() {
    const { stores } = useEditor();
    const empty = useDocument(({ document }) => document !== null && document.nodes.size === 1);
    if (!empty) {
        return null;
    }
    return (
        <div className="view-empty">
            <div className="glass">
                <p>{t("view.empty")}</p>
                <Button look="primary" onClick={() => stores.view.setState({ popup: "add" })}>
                    {t("view.emptyAdd")}
                </Button>
            </div>
        </div>
    );
}

/* One hint at a time; each goes for good when it was followed. */
function Hint() {
    const done = useView((view) => view.preferences.hintsDone);
    const pictured = useLink((state) => state.frame.state !== "none");
    const next = !done.includes("drag") ? "drag" : !done.includes("click") ? "click" : null;
    const touch = useMedia(TOUCH);
    useFollowed(next);
    if (!pictured || next === null) {
        return null;
    }
    return (
        <p className="glass view-hint">
            {t(next === "drag" ? "view.hintDrag" : touch ? "view.hintTap" : "view.hintClick")}
        </p>
    );
}

function useFollowed(hint: "drag" | "click" | null): void {
    const { stores } = useEditor();
    useEffect(() => {
        const done = (name: string): void =>
            stores.view.setState(({ preferences }) => ({
                preferences: { ...preferences, hintsDone: [...preferences.hintsDone, name] },
            }));
        if (hint === "drag") {
            return stores.camera.subscribe(({ own }) => own && done(hint));
        }
        if (hint === "click") {
            return stores.view.subscribe((now, before) => {
                if (now.selection.length > 0 && now.selection !== before.selection) {
                    done(hint);
                }
            });
        }
        return undefined;
    }, [stores, hint]);
}
