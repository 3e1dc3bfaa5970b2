/* SPDX-License-Identifier: MIT */
/* Why files were not opened: the file, the line, and what stands there. */

import type { ImportProblem } from "../import.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { Dialog } from "../widgets/Dialog.tsx";
import "./scenes.css";

interface Props {
    problem: ImportProblem | null;
    /* One of several scenes. */
    onChoose: (scene: string) => void;
    onClose: () => void;
}

export default function ImportFault({ problem, onChoose, onClose }: Props) {
    return (
        <Dialog
            open={problem !== null}
            title={t(problem?.choices.length ? "import.which" : "import.refused")}
            closeLabel={t("close")}
            onClose={onClose}
        >
            {problem && (
                <div className="fault" data-testid="import-fault">
                    <p className="fault-place" hidden={problem.file === ""}>
                        <b>{problem.file}</b>
                        {problem.line !== null && (
                            <span>
                                {t("code.place", {
                                    line: problem.line,
                                    column: problem.column ?? 1,
                                })}
                            </span>
                        )}
                    </p>
                    <p>{problem.choices.length > 0 ? t("import.choose") : problem.message}</p>
                    {problem.excerpt.length > 0 && <Excerpt problem={problem} />}
                    <div className="fault-choices">
                        {problem.choices.map((scene) => (
                            <Button key={scene} look="outline" onClick={() => onChoose(scene)}>
                                {scene}
                            </Button>
                        ))}
                    </div>
                    <Button
                        className="fault-close"
                        look={problem.choices.length > 0 ? "outline" : "primary"}
                        onClick={onClose}
                    >
                        {t("close")}
                    </Button>
                </div>
            )}
        </Dialog>
    );
}

const bringInSight = (one: HTMLElement | null): void => one?.scrollIntoView({ inline: "nearest" });

function Excerpt({ problem: { excerpt, from, line, column } }: { problem: ImportProblem }) {
    return (
        // biome-ignore lint/a11y/noNoninteractiveTabindex: it scrolls, so keys must reach it
        <pre className="fault-text" tabIndex={0}>
            {excerpt.map((text, i) => {
                const here = from + i === line;
                return (
                    // biome-ignore lint/suspicious/noArrayIndexKey: a line is its number
                    <span key={from + i} data-here={here || undefined}>
                        <i>{from + i}</i>
                        {text}
                        {"\n"}
                        {here && column !== null && (
                            <>
                                <i />
                                {" ".repeat(column - 1)}
                                <b ref={bringInSight}>^</b>
                                {"\n"}
                            </>
                        )}
                    </span>
                );
            })}
        </pre>
    );
}
