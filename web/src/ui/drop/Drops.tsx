/* SPDX-License-Identifier: MIT */
/* Files dropped on the editor: the zone that is seen while they hover, and what is asked then. */
import { FileDown } from "lucide-react";
import { useState } from "react";
import { type ImportProblem, openFiles } from "../import.ts";
import ImportFault from "../scenes/ImportFault.tsx";
import { useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { useDrop } from "./drop.ts";
import Offer from "./Offer.tsx";
import { takeFiles } from "./take.ts";
import "./drop.css";

export default function Drops() {
    const editor = useEditor();
    const [problem, setProblem] = useState<ImportProblem | null>(null);
    const hovering = useDrop((files) => void takeFiles(editor, files, setProblem));
    return (
        <>
            {hovering && (
                <div className="drop-zone" data-testid="drop-zone">
                    <FileDown size={28} aria-hidden="true" />
                    <p>{t("drop.zone")}</p>
                    <p className="drop-more">{t("drop.zoneMore")}</p>
                </div>
            )}
            <Offer />
            <ImportFault
                problem={problem}
                onChoose={(scene) => {
                    setProblem(null);
                    void openFiles(editor, problem?.files ?? [], setProblem, scene);
                }}
                onClose={() => setProblem(null)}
            />
        </>
    );
}
