/* SPDX-License-Identifier: MIT */
/* The arrow that moves the plane of the section, and the plane's outline. Placed outside of React. */
import { useEffect, useRef } from "react";
import type { PointerActions } from "../../overlay/pointer.ts";
import { SectionHand } from "../../overlay/section.ts";
import { useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import "./section.css";

interface Props {
    /* What a pointer means that is not for the arrow. */
    actions: PointerActions;
}

export default function SectionHandle({ actions }: Props) {
    const cut = useView(({ section }) => section !== null);
    return cut ? <Handle actions={actions} /> : null;
}

function Handle({ actions }: Props) {
    const { stores } = useEditor();
    const field = useRef<HTMLDivElement>(null);
    const room = useRef<HTMLDivElement>(null);
    const arrow = useRef<HTMLDivElement>(null);
    const outline = useRef<SVGSVGElement>(null);
    const told = useRef<HTMLDivElement>(null);
    useEffect(() => {
        const parts = [field.current, room.current, arrow.current, told.current];
        const [whole, free, held, words] = parts;
        if (!whole || !free || !held || !words || !outline.current) {
            return;
        }
        const hand = new SectionHand(stores, actions, {
            ...{ field: whole, room: free, arrow: held, told: words },
            outline: outline.current,
        });
        return () => hand.end();
    }, [stores, actions]);
    return (
        <div ref={field} className="section-field">
            <div ref={room} className="section-room" />
            <svg ref={outline} className="section-plane" aria-hidden="true">
                <path className="section-halo" />
                <path />
            </svg>
            <div
                ref={arrow}
                className="section-arrow"
                data-testid="section-arrow"
                role="slider"
                tabIndex={0}
                aria-label={t("section.arrow")}
                aria-valuenow={0}
                hidden
            >
                <svg aria-hidden="true">
                    {["section-halo", ""].map((look) => (
                        <g key={look} className={look}>
                            <path d="M0 0H56" />
                            <path className="section-tip" d="M66 0L51 -7V7Z" />
                            <circle r="5" />
                        </g>
                    ))}
                </svg>
            </div>
            <div ref={told} className="section-told" aria-hidden="true" hidden />
        </div>
    );
}
