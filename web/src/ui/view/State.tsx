/* SPDX-License-Identifier: MIT */
/* What is honest about the picture on screen: how it stands to the newest state, and by which
 * renderer it was drawn. */
import { CircleAlert, Cpu, RotateCw } from "lucide-react";
import { useEffect, useState } from "react";
import type { Problem } from "../../model/operation.ts";
import { type Pill, pillOf } from "../../model/pill.ts";
import { brokenCode, foremost, isGivenUp, isTooSlow } from "../../model/problems.ts";
import type { Compiling } from "../../model/stores.ts";
import { showPlace } from "../insertions.ts";
import { drawnBy } from "../names.ts";
import { useDocument, useEditor, useLink } from "../state.ts";
import { t } from "../texts.ts";
import { Tip } from "../widgets/Tip.tsx";
import "./view.css";

export function StatePill() {
    const problem = useDocument(({ problems }) => foremost(problems));
    const revision = useDocument((state) => state.revision);
    const waiting = useDocument((state) => state.waiting);
    const { connection, frame, moving, compiling } = useLink((state) => state);
    const pill = pillOf({
        connection,
        frame,
        revision,
        waiting,
        moving,
        compiling: compiling !== null,
        problem,
    });
    return (
        <span
            className="glass pill"
            data-testid="state"
            data-state={pill.state}
            data-revision={frame.revision}
            role="status"
        >
            <span className="pill-dot" />
            {pill.state === "compiling" && compiling !== null ? (
                <CompilingText {...compiling} />
            ) : (
                textOf(pill, frame.state === "none", problem)
            )}
        </span>
    );
}

function textOf(pill: Pill, empty: boolean, problem: Problem | null): string {
    const { state, behind, percent, round, rounds } = pill;
    switch (state) {
        case "offline":
            return t(empty ? "state.offlineEmpty" : "state.offline");
        case "ended":
            return t(empty ? "state.endedEmpty" : "state.ended");
        case "givenUp":
            return t(problem && isTooSlow(problem) ? "state.tooSlow" : "state.crashed");
        case "behind":
            return t("state.behind", { count: behind });
        case "moving":
            return t("state.moving", { percent });
        case "refining":
            return round > 0 ? t("state.round", { round, rounds }) : t("state.refining");
        default:
            return t(`state.${state}`);
    }
}

/* "compiling 3 s of about 6 s" */
function CompilingText({ since, expected }: Compiling) {
    const [now, setNow] = useState(performance.now());
    useEffect(() => {
        const timer = setInterval(() => setNow(performance.now()), 500);
        return () => clearInterval(timer);
    }, []);
    const elapsed = Math.max(0, Math.round((now - since) / 1000));
    const about = expected === null ? 0 : Math.round(expected / 1000);
    return about >= 1 && elapsed <= 2 * about
        ? t("state.compilingOf", { elapsed, about })
        : elapsed >= 1
          ? t("state.compiling", { elapsed })
          : t("state.compilingNow");
}

/* The picture is that of the last code that compiled; a press leads to what does not. What was
 * given up is tried again on request. */
export function BrokenPill() {
    const editor = useEditor();
    const problem = useDocument(({ problems }) => foremost(problems));
    const count = useDocument(({ problems }) => brokenCode(problems).length);
    if (problem === null) {
        return null;
    }
    const { code, place, message } = problem;
    return (
        <>
            <Tip text={message} note={place} side="top">
                <button
                    type="button"
                    className="glass pill pill-bad"
                    data-testid="broken"
                    onClick={() => showPlace(editor, place, true)}
                >
                    <CircleAlert size={14} aria-hidden="true" />
                    {brokenText(problem, count)}
                </button>
            </Tip>
            {isGivenUp(code) && (
                <button
                    type="button"
                    className="glass pill"
                    data-testid="retry"
                    onClick={() => editor.link.tryAgain(place)}
                >
                    <RotateCw size={14} aria-hidden="true" />
                    {t("notices.act.retry")}
                </button>
            )}
        </>
    );
}

/* Why something was given up is told beside it. */
function brokenText({ code, line }: Problem, count: number): string {
    if (isGivenUp(code)) {
        return t("state.where");
    }
    return line === undefined ? t("state.broken", { count }) : t("state.brokenLine", { line });
}

export function SoftwareChip() {
    const renderer = useLink((state) => state.renderer);
    if (!renderer?.software) {
        return null;
    }
    return (
        <Tip text={t("state.softwareDoc", { name: drawnBy(renderer) })} side="top">
            <button type="button" className="glass pill pill-amber" data-testid="software">
                <Cpu size={14} aria-hidden="true" />
                {t("state.software")}
            </button>
        </Tip>
    );
}
