/* SPDX-License-Identifier: MIT */
/* The plane that cuts this page's pictures: across which axis, which side, where; and the way out. */
import { FlipHorizontal2, SquareSplitHorizontal } from "lucide-react";
import { useEffect } from "react";
import { extentOf } from "../../model/actions.ts";
import type { Box } from "../../model/camera.ts";
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
/* The scene rests before it is asked for its size. */
const REST_MS = 300;

export default function Section() {
    const section = useView((view) => view.section);
    return (
        <div role="status" className="view-section">
            {section !== null && <Controls section={section} />}
        </div>
    );
}

/* Around what is shown, also when that has changed. */
function useExtent(): Box {
    const editor = useEditor();
    const document = useDocument((state) => state.document);
    const isolated = useView((view) => view.isolated);
    useEffect(() => {
        const ask = async (): Promise<void> => {
            const now = document && (await extentOf(editor, isolated));
            if (now) {
                editor.stores.view.setState({ extent: now.box });
            }
        };
        const timer = setTimeout(ask, REST_MS);
        return () => clearTimeout(timer);
    }, [editor, document, isolated]);
    return useView((view) => view.extent);
}

function Controls({ section }: { section: Cut }) {
    const { stores } = useEditor();
    const extent = useExtent();
    const { low, high } = sectionRange(section.axis, extent);
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
                    onClick={() => set(sectionAcross(section, axis, extent))}
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
