/* SPDX-License-Identifier: MIT */
/* Buttons: with words, or an icon whose name is a tooltip and the accessible name at once. */
import type { ButtonHTMLAttributes, ReactElement, ReactNode, Ref } from "react";
import { Tip } from "./Tip.tsx";
import "./button.css";

type Look = "plain" | "outline" | "primary" | "danger";

interface ButtonProps extends ButtonHTMLAttributes<HTMLButtonElement> {
    look?: Look;
    icon?: ReactNode;
    ref?: Ref<HTMLButtonElement>;
}

export function Button({ look = "plain", icon, children, className = "", ...rest }: ButtonProps) {
    return (
        <button type="button" className={`button ${className}`} data-look={look} {...rest}>
            {icon}
            {children}
        </button>
    );
}

interface IconButtonProps extends Omit<ButtonProps, "icon" | "children" | "title"> {
    title: string;
    keys?: string;
    children: ReactNode;
}

/* A disabled one stays focusable and says why: `whyNot` takes the place of the key in the tip. */
export function IconButton({
    title,
    keys,
    children,
    look = "plain",
    className = "",
    whyNot,
    onClick,
    ...rest
}: IconButtonProps & { whyNot?: string | null }): ReactElement {
    return (
        <Tip text={title} keys={whyNot ? undefined : keys} note={whyNot ?? undefined}>
            <button
                type="button"
                className={`icon-button ${className}`}
                data-look={look}
                aria-label={title}
                aria-disabled={whyNot ? true : undefined}
                onClick={whyNot ? undefined : onClick}
                {...rest}
            >
                {children}
            </button>
        </Tip>
    );
}
