/* SPDX-License-Identifier: MIT */
/* A named part of the page that F6 can reach. */
import type { ReactNode } from "react";
import type { Context } from "../../model/commands.ts";
import "./layout.css";

interface Props {
    as?: "section" | "header" | "footer";
    name: string;
    /* Which keys work while the focus is inside. */
    context?: Context;
    className?: string;
    children: ReactNode;
}

export function Region({
    as: Tag = "section",
    name,
    context,
    className = "region",
    children,
}: Props) {
    return (
        <Tag
            className={className}
            aria-label={name}
            data-region={name}
            data-context={context}
            tabIndex={-1}
        >
            {children}
        </Tag>
    );
}
