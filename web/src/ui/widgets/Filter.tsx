/* SPDX-License-Identifier: MIT */
/* A field that filters a list: a magnifier before it, a cross behind what is typed. */
import { Search, X } from "lucide-react";
import type { KeyboardEventHandler, Ref } from "react";
import { t } from "../texts.ts";
import { IconButton } from "./Button.tsx";
import "./filter.css";

interface Props {
    ref?: Ref<HTMLInputElement>;
    label: string;
    className?: string;
    value: string;
    onChange: (value: string) => void;
    onKeyDown?: KeyboardEventHandler;
}

export function Filter({ label, className = "", onChange, ...rest }: Props) {
    return (
        <div className={`filter ${className}`}>
            <Search size={13} aria-hidden="true" />
            <input
                {...rest}
                type="text"
                aria-label={label}
                placeholder={label}
                spellCheck={false}
                autoComplete="off"
                onChange={(event) => onChange(event.target.value)}
            />
            {rest.value !== "" && (
                <IconButton
                    title={t("scene.clearFilter")}
                    data-size="s"
                    onClick={() => onChange("")}
                >
                    <X size={13} />
                </IconButton>
            )}
        </div>
    );
}
