/* SPDX-License-Identifier: MIT */
/* The axes of the world in a corner of the picture; a click on an end looks from there. Moved
 * outside of React, with the camera of the picture shown. */
import { useEffect, useRef } from "react";
import { type AxisEnd, axisEnds } from "../../model/axesBall.ts";
import { DEFAULT_CAMERA } from "../../model/camera.ts";
import { commandById, runCommand } from "../../model/commandLookup.ts";
import { drawOver, shownCamera } from "../../overlay/shown.ts";
import { useEditor } from "../state.ts";
import { t } from "../texts.ts";
import "./view.css";

/* CSS pixels: from the middle to an end, and across an end. */
const RADIUS = 32;
const END = 24;

function place(ball: HTMLElement, ends: readonly AxisEnd[]): void {
    for (const { view, x, y, near, covered } of ends) {
        const end = ball.querySelector<HTMLElement>(`[data-view="${view}"]`);
        const line = ball.querySelector<SVGLineElement>(`[data-line="${view}"]`);
        if (end) {
            end.style.translate = `${x * RADIUS}px ${y * RADIUS}px`;
            end.style.zIndex = String(Math.round(10 + 9 * near));
            end.style.opacity = String(0.75 + 0.25 * near);
            end.hidden = covered;
        }
        line?.setAttribute("x2", String(x * RADIUS));
        line?.setAttribute("y2", String(y * RADIUS));
    }
}

export function AxesBall() {
    const editor = useEditor();
    const { stores } = editor;
    const ball = useRef<HTMLDivElement>(null);
    useEffect(
        () =>
            drawOver(stores, () => {
                const camera = shownCamera(stores);
                if (ball.current) {
                    ball.current.hidden = camera === null;
                    place(ball.current, axisEnds(camera ?? DEFAULT_CAMERA, END / RADIUS));
                }
            }),
        [stores],
    );
    return (
        // biome-ignore lint/a11y/useSemanticElements: a fieldset brings a look of its own
        <div ref={ball} className="axes-ball" role="group" aria-label={t("axes.title")} hidden>
            <svg aria-hidden="true">
                {ENDS.filter(({ positive }) => positive).map(({ view, axis }) => (
                    <line key={view} data-line={view} data-axis={axis} />
                ))}
            </svg>
            {ENDS.map(({ view, axis, positive }) => {
                const command = commandById(`camera.${view}`);
                return (
                    <button
                        key={view}
                        type="button"
                        tabIndex={-1}
                        data-view={view}
                        data-axis={axis}
                        data-negative={positive ? undefined : ""}
                        aria-label={command?.title}
                        title={command?.title}
                        onClick={() => command && runCommand(editor, command)}
                    >
                        <span>{positive ? axis.toUpperCase() : ""}</span>
                    </button>
                );
            })}
        </div>
    );
}

/* Which there are; where they stand is told by each camera. */
const ENDS = axisEnds(DEFAULT_CAMERA, 0);
