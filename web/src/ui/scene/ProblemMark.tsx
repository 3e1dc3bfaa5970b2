/* SPDX-License-Identifier: MIT */
/* The mark of a node that has a problem, or has one below it; what it is, is told by its tip. */
import { CircleAlert } from "lucide-react";
import { problemIn } from "../../model/problems.ts";
import { useDocument } from "../state.ts";
import { sentence, t } from "../texts.ts";
import "./scene.css";

export function ProblemMark({ id }: { id: string }) {
    const problem = useDocument(({ problems }) => {
        const found = problemIn(problems, `/nodes/${id}`);
        return found && sentence(found);
    });
    return (
        problem && (
            <span
                className="tree-error"
                role="img"
                title={problem}
                aria-label={t("scene.problem", { message: problem })}
            >
                <CircleAlert size={14} />
            </span>
        )
    );
}
