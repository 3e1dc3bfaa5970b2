/* SPDX-License-Identifier: MIT */
/* What is honest about the picture on screen: moving, still, lossless, compiling, by which
 * renderer. */
import { CircleAlert, Cpu } from "lucide-react";
import { brokenCode } from "../../model/problems.ts";
import { showPlace } from "../acts.ts";
import { Tip } from "../parts/Tip.tsx";
import { useDocument, useEditor, useLink } from "../state.ts";
import { t } from "../texts.ts";
import "./view.css";

export function StatePill() {
    const broken = useDocument(({ problems }) => brokenCode(problems).length > 0);
    const state = useLink(({ frame }) =>
        frame.stale ? (broken ? "kept" : "compiling") : frame.state,
    );
    const percent = useLink(({ frame }) => Math.round(frame.scale * 100));
    const revision = useLink(({ frame }) => frame.revision);
    return (
        <span
            className="glass pill"
            data-testid="state"
            data-state={state}
            data-revision={revision}
            role="status"
        >
            <span className="pill-dot" />
            {t(`state.${state}`, { percent })}
        </span>
    );
}

/* The picture is that of the last code that compiled; a press leads to what does not. */
export function BrokenPill() {
    const editor = useEditor();
    const problem = useDocument(({ problems }) => brokenCode(problems)[0] ?? null);
    const count = useDocument(({ problems }) => brokenCode(problems).length);
    if (problem === null) {
        return null;
    }
    return (
        <Tip text={problem.message} note={problem.place} side="top">
            <button
                type="button"
                className="glass pill pill-bad"
                data-testid="broken"
                onClick={() => showPlace(editor, problem.place, true)}
            >
                <CircleAlert size={14} aria-hidden="true" />
                {problem.line === undefined
                    ? t("state.broken", { count })
                    : t("state.brokenLine", { line: problem.line })}
            </button>
        </Tip>
    );
}

export function SoftwareChip() {
    const renderer = useLink((state) => state.renderer);
    if (!renderer?.software) {
        return null;
    }
    return (
        <Tip text={t("state.softwareDoc", { name: renderer.name })} side="top">
            <button type="button" className="glass pill pill-amber" data-testid="software">
                <Cpu size={14} aria-hidden="true" />
                {t("state.software")}
            </button>
        </Tip>
    );
}
