/* SPDX-License-Identifier: MIT */
/* Menus: opened by a button, or at a point (a right click or a long press). */
import { Menu as Base } from "@base-ui/react/menu";
import { Check } from "lucide-react";
import { type ReactElement, type ReactNode, type RefObject, useEffect, useRef } from "react";
import "./popup.css";

interface MenuProps {
    trigger: ReactElement;
    align?: "start" | "center" | "end";
    children: ReactNode;
}

/* The region of a menu that was opened. It takes the focus when a choice takes the menu and its
 * button away, unless the choice leads elsewhere. */
function useRegion() {
    const button = useRef<HTMLButtonElement>(null);
    const region = useRef<HTMLElement | null>(null);
    const onOpenChange = (open: boolean): void => {
        if (open) {
            region.current = button.current?.closest<HTMLElement>("[data-region]") ?? null;
        }
    };
    useEffect(
        () => () =>
            queueMicrotask(() => {
                if (document.activeElement === document.body) {
                    region.current?.focus();
                }
            }),
        [],
    );
    return { button, onOpenChange };
}

export function Menu({ trigger, align = "start", children }: MenuProps) {
    const { button, onOpenChange } = useRegion();
    return (
        <Base.Root modal={false} onOpenChange={onOpenChange}>
            <Base.Trigger ref={button} render={trigger} />
            <Base.Portal>
                <Base.Positioner className="above-all" align={align} sideOffset={4}>
                    <Base.Popup className="popup menu">{children}</Base.Popup>
                </Base.Positioner>
            </Base.Portal>
        </Base.Root>
    );
}

/* Where a menu was asked for, in CSS pixels of the window. */
export interface MenuPlace {
    readonly x: number;
    readonly y: number;
}

/* A menu stays inside the window: it is shifted rather than cut off. */
const SHIFT = { side: "shift", align: "shift", fallbackAxisSide: "none" } as const;

interface PointMenuProps {
    at: MenuPlace | null;
    label: string;
    onClose: () => void;
    children: ReactNode;
}

/* A finger on the picture brings none of the mouse's events, by which a menu sees that it is left. */
function useTouchOutside(popup: RefObject<HTMLElement | null>, onTouch: () => void): void {
    useEffect(() => {
        const press = ({ pointerType, target }: PointerEvent): void => {
            const { current } = popup;
            if (pointerType === "touch" && current && !current.contains(target as Node)) {
                onTouch();
            }
        };
        document.addEventListener("pointerdown", press, true);
        return () => document.removeEventListener("pointerdown", press, true);
    }, [popup, onTouch]);
}

export function PointMenu({ at, label, onClose, children }: PointMenuProps) {
    const popup = useRef<HTMLDivElement>(null);
    useTouchOutside(popup, onClose);
    const anchor = at && { getBoundingClientRect: () => new DOMRect(at.x, at.y, 0, 0) };
    return (
        <Base.Root open={at !== null} onOpenChange={(open) => open || onClose()} modal={false}>
            <Base.Portal>
                <Base.Positioner
                    className="above-all"
                    anchor={anchor}
                    align="start"
                    sideOffset={2}
                    collisionPadding={8}
                    collisionAvoidance={SHIFT}
                >
                    <Base.Popup ref={popup} className="popup menu" aria-label={label}>
                        {children}
                    </Base.Popup>
                </Base.Positioner>
            </Base.Portal>
        </Base.Root>
    );
}

interface ItemProps {
    icon?: ReactNode;
    keys?: string;
    /* What it is, in a smaller line below. */
    doc?: string;
    /* One of several of which one holds. */
    checked?: boolean;
    danger?: boolean;
    disabled?: boolean;
    /* The pointer or a key comes to it. */
    onReach?: () => void;
    onSelect: () => void;
    children: ReactNode;
}

export function MenuItem(props: ItemProps) {
    const { icon, keys, doc, checked, danger, disabled, onReach, onSelect, children } = props;
    const radio = checked === undefined ? {} : { role: "menuitemradio", "aria-checked": checked };
    return (
        <Base.Item
            className="menu-item"
            data-danger={danger || undefined}
            disabled={disabled}
            onFocus={onReach}
            onClick={onSelect}
            {...radio}
        >
            <span className="menu-icon">{checked ? <Check size={14} /> : icon}</span>
            <span className="menu-text">
                {children}
                {doc && <span className="menu-doc">{doc}</span>}
            </span>
            {keys && <span className="menu-keys">{keys}</span>}
        </Base.Item>
    );
}

/* What the menu is about. */
export function MenuTitle({ children }: { children: ReactNode }) {
    return <p className="menu-title ellipsis">{children}</p>;
}

/* A remark below an item: why it cannot be chosen. */
export function MenuNote({ children }: { children: ReactNode }) {
    return <p className="menu-note">{children}</p>;
}

export function MenuLine() {
    return <Base.Separator className="menu-line" />;
}
