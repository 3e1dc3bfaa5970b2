/* SPDX-License-Identifier: MIT */
/* The steps of Buchberger's algorithm: how many pairs had which outcome, how many are left, and the
 * newest ones in a table. */
import { countOutcomes, OUTCOMES, type Step } from "../../model/basis.ts";
import { Polynomial } from "./Polynomial.tsx";
import { fill, OUTCOME_TEXTS, TEXTS } from "./texts.ts";

/* Rows of the table: what is older is counted. */
const SHOWN = 100;

export function Steps({ steps }: { steps: readonly Step[] }) {
    const counts = countOutcomes(steps);
    const hidden = Math.max(0, steps.length - SHOWN);
    return (
        <section aria-label={TEXTS.steps}>
            <h3>{TEXTS.steps}</h3>
            <ul className="workbench-counts">
                {OUTCOMES.map((outcome) => (
                    <li key={outcome} data-outcome={outcome}>
                        <strong>{counts[outcome]}</strong> {OUTCOME_TEXTS[outcome]}
                    </li>
                ))}
            </ul>
            <Graph steps={steps} />
            <p>{TEXTS.graph}</p>
            <table className="workbench-steps">
                <thead>
                    <tr>
                        <th>{TEXTS.pair}</th>
                        <th>{TEXTS.outcome}</th>
                        <th>{TEXTS.degree}</th>
                        <th>{TEXTS.divisions}</th>
                        <th>{TEXTS.leading}</th>
                    </tr>
                </thead>
                <tbody>
                    {steps
                        .slice(hidden)
                        .reverse()
                        .map((step) => (
                            <StepRow key={step.pair.join()} step={step} />
                        ))}
                </tbody>
            </table>
            {hidden > 0 && <p>{fill(TEXTS.hidden, { count: hidden })}</p>}
        </section>
    );
}

function StepRow({ step }: { step: Step }) {
    const { pair, outcome, degree, divisions, element, leading } = step;
    return (
        <tr data-outcome={outcome}>
            <td>{pair.join(", ")}</td>
            <td>{OUTCOME_TEXTS[outcome]}</td>
            <td>{degree}</td>
            <td>{divisions || ""}</td>
            <td>
                {element !== null && (
                    <>
                        <Polynomial text={leading} /> → {element}
                    </>
                )}
            </td>
        </tr>
    );
}

const WIDTH = 400;
const HEIGHT = 48;

/* Pairs left after each step. */
function Graph({ steps }: { steps: readonly Step[] }) {
    const most = Math.max(1, ...steps.map(({ waiting }) => waiting));
    const points = steps.map(({ waiting }, i) => {
        const x = (WIDTH * i) / Math.max(1, steps.length - 1);
        return `${x.toFixed(1)},${(HEIGHT - (HEIGHT * waiting) / most).toFixed(1)}`;
    });
    return (
        <svg
            className="workbench-graph"
            viewBox={`0 -1 ${WIDTH} ${HEIGHT + 2}`}
            preserveAspectRatio="none"
            aria-hidden="true"
        >
            <polyline points={points.join(" ")} vectorEffect="non-scaling-stroke" />
        </svg>
    );
}
