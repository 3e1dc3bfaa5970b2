/* SPDX-License-Identifier: MIT */
/* Distances in the scene: two clicks, a line between them, its length and what it is along each axis.
 * Nothing of the scene changes. */
import { length, subtract, type Vector } from "../../model/transform.ts";
import { shortNumber } from "../../model/units.ts";
import { useView } from "../state.ts";
import { t } from "../texts.ts";
import "./view.css";

/* What to click next, or the figures. */
export default function Measured() {
    const points = useView((view) => view.measured);
    if (points === null) {
        return null;
    }
    const [from, to] = points;
    return (
        <p className="glass view-hint measured" role="status" data-testid="measured">
            {from && to ? (
                <Figures by={subtract(to, from)} />
            ) : (
                t(from ? "measure.second" : "measure.first")
            )}
        </p>
    );
}

function Figures({ by }: { by: Vector }) {
    return (
        <>
            <strong>{shortNumber(length(by))}</strong>
            {["x", "y", "z"].map((axis, i) => (
                <span key={axis} data-axis={axis}>
                    {axis.toUpperCase()} {shortNumber(by[i] ?? 0)}
                </span>
            ))}
        </>
    );
}
