/* SPDX-License-Identifier: MIT */
/* The field on top of a palette and the line of keys below it. */
import { Search as Icon } from "lucide-react";
import type { ReactNode, Ref } from "react";
import { t } from "../texts.ts";
import "./palettes.css";

interface Props {
    ref?: Ref<HTMLInputElement>;
    label: string;
    placeholder: string;
    value: string;
    listId: string;
    activeId: string | undefined;
    onChange: (value: string) => void;
    onKeyDown: (event: React.KeyboardEvent) => void;
}

export function Search({ label, listId, activeId, onChange, ...rest }: Props) {
    return (
        <div className="palette-search">
            <Icon size={17} aria-hidden="true" />
            <input
                {...rest}
                type="text"
                role="combobox"
                aria-label={label}
                aria-expanded="true"
                aria-controls={listId}
                aria-activedescendant={activeId}
                aria-autocomplete="list"
                spellCheck={false}
                autoComplete="off"
                onChange={(event) => onChange(event.target.value)}
            />
        </div>
    );
}

/* `drags`: what is active can be dragged onto the picture. */
export function Foot({ drags, children }: { drags?: boolean; children?: ReactNode }) {
    return (
        <div className="palette-foot">
            <span>
                <kbd>↑</kbd> <kbd>↓</kbd> {t("palette.move")}
            </span>
            <span>
                <kbd>Enter</kbd> {t("palette.choose")}
            </span>
            <span>
                <kbd>{drags ? t("hint.drag") : "Esc"}</kbd>{" "}
                {t(drags ? "palette.place" : "palette.close")}
            </span>
            <span className="palette-more">{children}</span>
        </div>
    );
}
