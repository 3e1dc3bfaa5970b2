/* SPDX-License-Identifier: MIT */
/* The plane that cuts this page's pictures: across which axis, which side, where; and the way out. */
import { FlipHorizontal2, SquareSplitHorizontal } from "lucide-react";
import { useMemo } from "react";
import { ballOf } from "../../model/bounds.ts";
import {
    type Section as Cut,
    SECTION_AXES,
    sectionAcross,
    sectionRange,
} from "../../model/section.ts";
import { shortNumber } from "../../model/units.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Button, IconButton } from "../widgets/Button.tsx";
import "./section.css";

/* Of the slider. */
const STEPS = 400;

export default function Section() {
    const section = useView((view) => view.section);
    return (
        <div role="status" className="view-section">
            {section !== null && <Controls section={section} />}
        </div>
    );
}

function Controls({ section }: { section: Cut }) {
    const { stores } = useEditor();
    const document = useDocument((state) => state.document);
    const schema = useDocument((state) => state.schema);
    const ball = useMemo(
        () => (document ? ballOf(document, schema) : { center: [0, 0, 0] as const, radius: 1 }),
        [document, schema],
    );
    const { low, high } = sectionRange(section.axis, ball);
    const set = (next: Cut | null): void => stores.view.setState({ section: next });
    return (
        <fieldset className="glass pill section-bar" data-testid="section">
            <legend className="unseen">{t("section.title")}</legend>
            <SquareSplitHorizontal size={14} aria-hidden="true" />
            {SECTION_AXES.map((axis) => (
                <button
                    key={axis}
                    type="button"
                    data-axis={axis}
                    aria-label={t("section.axis", { axis: axis.toUpperCase() })}
                    aria-pressed={axis === section.axis}
                    onClick={() => set(sectionAcross(section, axis, ball))}
                >
                    {axis.toUpperCase()}
                </button>
            ))}
            <IconButton
                title={t("section.flip")}
                aria-pressed={section.flipped}
                onClick={() => set({ ...section, flipped: !section.flipped })}
            >
                <FlipHorizontal2 size={15} aria-hidden="true" />
            </IconButton>
            <input
                type="range"
                min={Math.min(low, section.at)}
                max={Math.max(high, section.at)}
                step={(high - low) / STEPS}
                value={section.at}
                aria-label={t("section.at")}
                onChange={({ target }) => set({ ...section, at: Number(target.value) })}
            />
            <output>{shortNumber(section.at)}</output>
            <Button onClick={() => set(null)}>{t("section.end")}</Button>
        </fieldset>
    );
}
