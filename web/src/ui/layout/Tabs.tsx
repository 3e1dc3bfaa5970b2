/* SPDX-License-Identifier: MIT */
/* A row of tabs over one panel; arrows move between them. */
import { useRef } from "react";
import "./layout.css";

interface Props<T extends string> {
    tabs: readonly { id: T; title: string }[];
    active: T;
    /* Id of the element that shows the active tab's content. */
    panel: string;
    onChange: (id: T) => void;
}

export function Tabs<T extends string>({ tabs, active, panel, onChange }: Props<T>) {
    const list = useRef<HTMLDivElement>(null);
    const step = (by: number): void => {
        const now = tabs.findIndex(({ id }) => id === active);
        const next = (now + by + tabs.length) % tabs.length;
        const tab = tabs[next];
        if (tab) {
            onChange(tab.id);
            list.current?.querySelectorAll("button")[next]?.focus();
        }
    };
    return (
        <div
            ref={list}
            className="tabs"
            role="tablist"
            tabIndex={-1}
            onKeyDown={(event) => {
                const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
                if (by) {
                    event.preventDefault();
                    event.stopPropagation();
                    step(by);
                }
            }}
        >
            {tabs.map(({ id, title }) => (
                <button
                    key={id}
                    type="button"
                    role="tab"
                    className="tab"
                    aria-controls={panel}
                    aria-selected={active === id}
                    tabIndex={active === id ? 0 : -1}
                    onClick={() => onChange(id)}
                >
                    {title}
                </button>
            ))}
        </div>
    );
}
