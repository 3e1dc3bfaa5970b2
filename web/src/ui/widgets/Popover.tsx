/* SPDX-License-Identifier: MIT */
/* A small sheet beside the control that opened it. */
import { Popover as Base } from "@base-ui/react/popover";
import type { ReactElement, ReactNode } from "react";
import "./popup.css";

/* --bar of theme.css: its buttons stay whole beside what is higher than the panels. */
const BAR = 44;
const FREE = 8;
const PADDING = { top: BAR + FREE, right: FREE, bottom: FREE, left: FREE };

interface Props {
    trigger: ReactElement;
    label: string;
    side?: "top" | "bottom" | "left" | "right";
    align?: "start" | "center" | "end";
    /* Left out: the popover opens and closes by itself. */
    open?: boolean;
    onOpenChange?: (open: boolean) => void;
    children: ReactNode;
}

export function Popover({
    trigger,
    label,
    side = "bottom",
    align = "start",
    open,
    onOpenChange,
    children,
}: Props) {
    return (
        <Base.Root open={open} onOpenChange={(now) => onOpenChange?.(now)}>
            <Base.Trigger render={trigger} />
            <Base.Portal>
                <Base.Positioner
                    className="above-all"
                    side={side}
                    align={align}
                    sideOffset={6}
                    collisionPadding={PADDING}
                >
                    <Base.Popup className="popup popover" aria-label={label}>
                        {children}
                    </Base.Popup>
                </Base.Positioner>
            </Base.Portal>
        </Base.Root>
    );
}
