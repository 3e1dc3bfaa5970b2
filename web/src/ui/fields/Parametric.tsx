/* SPDX-License-Identifier: MIT */
/* The equation of a parametric surface: three expressions in two parameters; the server finds the
 * equation while they are typed, and proves it. */
import { useEffect, useState } from "react";
import { type Implicit, type PartTexts, RestError } from "../../link/rest.ts";
import { useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { Dialog } from "../widgets/Dialog.tsx";
import { Mark } from "./Mark.tsx";
import "./fields.css";

const PARTS = ["x", "y", "z"] as const;
/* Whitney's umbrella. */
const FIRST: PartTexts = { x: "s*t", y: "s", z: "t^2" };
/* A pause in typing after which the server is asked. */
const ASK_MS = 300;

interface Props {
    onTake: (equation: string) => void;
}

export function FromParametric({ onTake }: Props) {
    const [open, setOpen] = useState(false);
    const [texts, setTexts] = useState(FIRST);
    const take = (equation: string): void => {
        setOpen(false);
        onTake(equation);
    };
    return (
        <>
            <Button className="equation-from" onClick={() => setOpen(true)}>
                {t("parametric.open")}
            </Button>
            <Dialog
                open={open}
                title={t("parametric.title")}
                wide
                closeLabel={t("close")}
                onClose={() => setOpen(false)}
            >
                <Sheet texts={texts} onChange={setTexts} onTake={take} />
            </Dialog>
        </>
    );
}

interface Answer {
    found: Implicit | null;
    problem: RestError | null;
}

/* null: the server has not answered yet. */
function useEquation(texts: PartTexts): Answer | null {
    const { rest } = useEditor();
    const [answer, setAnswer] = useState<Answer | null>(null);
    useEffect(() => {
        const request = new AbortController();
        const tell = (next: Answer): void => {
            if (!request.signal.aborted) {
                setAnswer(next);
            }
        };
        setAnswer(null);
        const timer = setTimeout(() => {
            rest.implicitize(texts, request.signal).then(
                (found) => tell({ found, problem: null }),
                (problem) => tell({ found: null, problem: asProblem(problem) }),
            );
        }, ASK_MS);
        return () => {
            clearTimeout(timer);
            request.abort();
        };
    }, [rest, texts]);
    return answer;
}

const asProblem = (problem: unknown): RestError =>
    problem instanceof RestError ? problem : new RestError(0, "unreachable", "", String(problem));

interface SheetProps {
    texts: PartTexts;
    onChange: (texts: PartTexts) => void;
    onTake: (equation: string) => void;
}

function Sheet({ texts, onChange, onTake }: SheetProps) {
    const answer = useEquation(texts);
    const found = answer?.found ?? null;
    return (
        <>
            <div className="parametric">
                <p>{t("parametric.doc")}</p>
                {PARTS.map((part) => (
                    <Part
                        key={part}
                        part={part}
                        text={texts[part]}
                        problem={answer?.problem?.place === `/${part}` ? answer.problem : null}
                        onChange={(text) => onChange({ ...texts, [part]: text })}
                    />
                ))}
                {/* biome-ignore lint/a11y/noNoninteractiveTabindex: long equations scroll by keys */}
                <output tabIndex={0} aria-label={t("parametric.equation")}>
                    {found === null ? "" : `${found.equation} = 0`}
                </output>
            </div>
            <footer className="dialog-foot">
                <Verdict answer={answer} />
                <Button
                    look="primary"
                    disabled={!found?.drawable}
                    onClick={() => found && onTake(`${found.equation} = 0`)}
                >
                    {t("parametric.take")}
                </Button>
            </footer>
        </>
    );
}

interface PartProps {
    part: string;
    text: string;
    problem: RestError | null;
    onChange: (text: string) => void;
}

function Part({ part, text, problem, onChange }: PartProps) {
    return (
        <div className="parametric-part">
            <label htmlFor={`parametric-${part}`}>{part} =</label>
            <input
                id={`parametric-${part}`}
                className="text-field"
                value={text}
                spellCheck={false}
                autoComplete="off"
                aria-invalid={problem !== null || undefined}
                onChange={({ target }) => onChange(target.value)}
            />
            {problem?.line && <Mark text={text} line={problem.line} column={problem.column ?? 1} />}
        </div>
    );
}

/* What was proved, or why there is no equation. */
function Verdict({ answer }: { answer: Answer | null }) {
    const { found = null, problem = null } = answer ?? {};
    const place = problem?.place.replace("/", "");
    return (
        <p role="status" data-bad={problem !== null || found?.drawable === false || undefined}>
            {problem !== null && `${place ? `${place}: ` : ""}${problem.message}`}
            {found !== null && t("parametric.found", { degree: found.degree, terms: found.terms })}
            {found?.drawable === false && ` ${t("parametric.large", { why: found.why })}`}
            {answer === null && t("parametric.busy")}
        </p>
    );
}
