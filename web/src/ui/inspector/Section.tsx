/* SPDX-License-Identifier: MIT */
/* A heading that folds what is below it; an act of its own may stand at its end. */
import { ChevronRight } from "lucide-react";
import { type ReactNode, useId, useState } from "react";
import "./inspector.css";

interface Props {
    title: string;
    count?: number;
    action?: ReactNode;
    children: ReactNode;
}

export function Section({ title, count, action, children }: Props) {
    const [open, setOpen] = useState(true);
    const id = useId();
    return (
        <section className="section">
            <div className="section-top">
                <h2>
                    <button
                        type="button"
                        className="section-head"
                        aria-expanded={open}
                        aria-controls={id}
                        onClick={() => setOpen(!open)}
                    >
                        <ChevronRight size={13} aria-hidden="true" />
                        {title}
                        {count !== undefined && <span className="section-count">{count}</span>}
                    </button>
                </h2>
                {action}
            </div>
            <div id={id} hidden={!open}>
                {children}
            </div>
        </section>
    );
}
