/* SPDX-License-Identifier: MIT */
/* A tooltip: what it is, which key does it, and why it cannot be used now. */
import { Tooltip } from "@base-ui/react/tooltip";
import type { ReactElement } from "react";
import "./popup.css";

interface Props {
    text: string;
    keys?: string;
    note?: string;
    side?: "top" | "bottom" | "left" | "right";
    children: ReactElement;
}

export const TipProvider = Tooltip.Provider;

export function Tip({ text, keys, note, side = "bottom", children }: Props) {
    return (
        <Tooltip.Root
            /* Escape closes the tip and what it stands in. */
            onOpenChange={(_open, details) =>
                details.reason === "escape-key" && details.allowPropagation()
            }
        >
            <Tooltip.Trigger render={children} />
            <Tooltip.Portal>
                <Tooltip.Positioner side={side} sideOffset={6} className="above-all">
                    <Tooltip.Popup className="tip">
                        <span>{text}</span>
                        {keys && <kbd>{keys}</kbd>}
                        {note && <span className="tip-note">{note}</span>}
                    </Tooltip.Popup>
                </Tooltip.Positioner>
            </Tooltip.Portal>
        </Tooltip.Root>
    );
}
