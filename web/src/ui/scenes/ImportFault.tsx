/* SPDX-License-Identifier: MIT */
/* Why files were not opened: the file, the line, and what stands there. */

import type { ImportProblem } from "../import.ts";
import { Button } from "../parts/Button.tsx";
import { Dialog } from "../parts/Dialog.tsx";
import { t } from "../texts.ts";
import "./scenes.css";

interface Props {
    problem: ImportProblem | null;
    onClose: () => void;
}

export default function ImportFault({ problem, onClose }: Props) {
    return (
        <Dialog
            open={problem !== null}
            title={t("import.refused")}
            closeLabel={t("close")}
            onClose={onClose}
        >
            {problem && (
                <div className="fault" data-testid="import-fault">
                    <p className="fault-place">
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
                    <p>{problem.message}</p>
                    {problem.excerpt.length > 0 && <Excerpt problem={problem} />}
                    <Button look="primary" onClick={onClose}>
                        {t("close")}
                    </Button>
                </div>
            )}
        </Dialog>
    );
}

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
                                {`${" ".repeat(column - 1)}^\n`}
                            </>
                        )}
                    </span>
                );
            })}
        </pre>
    );
}
