/* SPDX-License-Identifier: MIT */
/* What is honest about the picture on screen: moving, still, lossless, compiling, by which
 * renderer. */
import { Cpu } from "lucide-react";
import { Tip } from "../parts/Tip.tsx";
import { useLink } from "../state.ts";
import { t } from "../texts.ts";
import "./view.css";

export function StatePill() {
    const state = useLink(({ frame }) => (frame.stale ? "compiling" : frame.state));
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
