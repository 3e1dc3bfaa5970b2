/* SPDX-License-Identifier: MIT */
/* A modal sheet with a title; Escape and a press outside close it. */
import { Dialog as Base } from "@base-ui/react/dialog";
import { X } from "lucide-react";
import { type ReactNode, type RefObject, useRef } from "react";
import { IconButton } from "./Button.tsx";
import "./popup.css";

interface Props {
    open: boolean;
    title: string;
    bare?: boolean /* the title is for screen readers only: palettes */;
    wide?: boolean;
    first?: RefObject<HTMLElement | null>;
    closeLabel: string;
    onClose: () => void;
    children: ReactNode;
}

export function Dialog({ open, title, bare, wide, first, closeLabel, onClose, children }: Props) {
    /* Not the button that closes it, which is the first. */
    const whole = useRef<HTMLDivElement>(null);
    return (
        <Base.Root open={open} onOpenChange={(now) => now || onClose()}>
            <Base.Portal>
                <Base.Backdrop className="backdrop" />
                <Base.Popup
                    ref={whole}
                    className="popup dialog"
                    data-bare={bare || undefined}
                    data-wide={wide || undefined}
                    initialFocus={first ?? whole}
                    /* A tip inside would take the key for itself. */
                    onKeyDown={(event) => {
                        const within = event.currentTarget.contains(event.target as Element);
                        if (event.key === "Escape" && within) {
                            onClose();
                        }
                    }}
                >
                    <header className={bare ? "unseen" : "dialog-head"}>
                        <Base.Title>{title}</Base.Title>
                        {!bare && (
                            <IconButton title={closeLabel} onClick={onClose}>
                                <X size={16} />
                            </IconButton>
                        )}
                    </header>
                    {children}
                </Base.Popup>
            </Base.Portal>
        </Base.Root>
    );
}
