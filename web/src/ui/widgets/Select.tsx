/* SPDX-License-Identifier: MIT */
/* One value out of a list too long for buttons side by side. */
import { Select as Base } from "@base-ui/react/select";
import { Check, ChevronsUpDown } from "lucide-react";
import type { ReactNode } from "react";
import { t } from "../texts.ts";
import "./popup.css";

export interface Option {
    value: string;
    label: string;
    icon?: ReactNode;
}

interface Props {
    value: string;
    options: readonly Option[];
    label: string;
    describedBy?: string;
    /* Looks like text until it is touched. */
    quiet?: boolean;
    /* What it is about differs: no option holds. */
    mixed?: boolean;
    onChange: (value: string) => void;
}

export function Select({ value, options, label, describedBy, quiet, mixed, onChange }: Props) {
    const shown = mixed ? undefined : options.find((option) => option.value === value);
    return (
        <Base.Root
            value={mixed ? null : value}
            items={options as Option[]}
            modal={false}
            onValueChange={(next) => next !== null && onChange(next as string)}
        >
            <Base.Trigger
                className="select"
                data-quiet={quiet || undefined}
                aria-label={label}
                aria-describedby={describedBy}
            >
                {shown?.icon}
                <span className="select-text ellipsis">
                    {shown?.label ?? (mixed ? t("field.mixed") : value)}
                </span>
                <ChevronsUpDown size={13} aria-hidden="true" />
            </Base.Trigger>
            <Base.Portal>
                <Base.Positioner className="above-all" sideOffset={4} alignItemWithTrigger={false}>
                    <Base.Popup className="popup menu">
                        <Base.List>
                            {options.map((option) => (
                                <Base.Item
                                    key={option.value}
                                    value={option.value}
                                    className="menu-item"
                                >
                                    <span className="menu-icon">{option.icon}</span>
                                    <Base.ItemText className="menu-text">
                                        {option.label}
                                    </Base.ItemText>
                                    <Base.ItemIndicator className="menu-keys">
                                        <Check size={14} />
                                    </Base.ItemIndicator>
                                </Base.Item>
                            ))}
                        </Base.List>
                    </Base.Popup>
                </Base.Positioner>
            </Base.Portal>
        </Base.Root>
    );
}
