/* SPDX-License-Identifier: MIT */
/* The equation of a parametric surface: three expressions in two parameters; the server finds the
 * equation while they are typed, and proves it. */
import { useEffect, useState } from "react";
import { type Implicit, RestError } from "../../link/rest.ts";
import { numberParam } from "../../model/schema.ts";
import {
    PARTS,
    type PartTexts,
    type Surface,
    type SurfaceRange,
    type SurfaceValue,
    surfaceValue,
} from "../../model/surface.ts";
import { paramTitle } from "../names.ts";
import { useDocument, useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { Dialog } from "../widgets/Dialog.tsx";
import { Select } from "../widgets/Select.tsx";
import { Mark } from "./Mark.tsx";
import { NumberField } from "./Number.tsx";
import { surfaceText } from "./surfaceTexts.ts";
import "./fields.css";

/* Whitney's umbrella. */
const FIRST: Surface = { texts: { x: "s*t", y: "s", z: "t^2" }, ranges: {} };
/* A pause in typing after which the server is asked. */
const ASK_MS = 300;

interface Props {
    open: boolean;
    /* What the node has; null: nothing yet. */
    start: Surface | null;
    onTake: (equation: string, surface: SurfaceValue) => void;
    onClose: () => void;
}

export function FromParametric({ open, start, onTake, onClose }: Props) {
    const [draft, setDraft] = useState<Surface | null>(null);
    return (
        <Dialog
            open={open}
            title={surfaceText("title")}
            wide
            closeLabel={t("close")}
            onClose={onClose}
        >
            <Sheet
                surface={draft ?? start ?? FIRST}
                onChange={setDraft}
                onTake={(equation, surface) => {
                    setDraft(null);
                    onTake(equation, surface);
                }}
            />
        </Dialog>
    );
}

export interface Answer {
    found: Implicit | null;
    problem: RestError | null;
}

/* null: the server has not answered yet. */
export function useEquation(texts: PartTexts, method: string | null): Answer | null {
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
            rest.implicitize(method === null ? texts : { ...texts, method }, request.signal).then(
                (found) => tell({ found, problem: null }),
                (problem) => tell({ found: null, problem: asProblem(problem) }),
            );
        }, ASK_MS);
        return () => {
            clearTimeout(timer);
            request.abort();
        };
    }, [rest, texts, method]);
    return answer;
}

const asProblem = (problem: unknown): RestError =>
    problem instanceof RestError ? problem : new RestError(0, "unreachable", "", String(problem));

interface SheetProps {
    surface: Surface;
    onChange: (surface: Surface) => void;
    onTake: (equation: string, surface: SurfaceValue) => void;
}

function Sheet({ surface, onChange, onTake }: SheetProps) {
    const { texts } = surface;
    /* null: as the server does. */
    const [method, setMethod] = useState<string | null>(null);
    const answer = useEquation(texts, method);
    const found = answer?.found ?? null;
    const equation = found === null ? "" : `${found.equation} = 0`;
    /* The fields of the letters stay while the server looks. */
    const [letters, setLetters] = useState<readonly string[]>(Object.keys(surface.ranges));
    const now = found?.letters ?? letters;
    useEffect(() => setLetters(now), [now]);
    const ranged = surfaceValue(surface, now) as Readonly<Record<string, SurfaceRange>>;
    const reversed = now.find(
        (letter) => !((ranged[letter]?.[0] ?? 0) < (ranged[letter]?.[1] ?? 0)),
    );
    return (
        <>
            <div className="parametric">
                <p>{surfaceText("doc")}</p>
                {PARTS.map((part) => (
                    <Part
                        key={part}
                        part={part}
                        text={texts[part]}
                        problem={answer?.problem?.place === `/${part}` ? answer.problem : null}
                        onChange={(text) =>
                            onChange({ ...surface, texts: { ...texts, [part]: text } })
                        }
                    />
                ))}
                {now.map((letter) => (
                    <Range
                        key={letter}
                        letter={letter}
                        range={ranged[letter] ?? [0, 0]}
                        onChange={(range) =>
                            onChange({ texts, ranges: { ...surface.ranges, [letter]: range } })
                        }
                    />
                ))}
                <Method value={method} onChange={setMethod} />
                {/* biome-ignore lint/a11y/noNoninteractiveTabindex: long equations scroll by keys */}
                <output tabIndex={0} aria-label={surfaceText("equation")}>
                    {equation}
                </output>
            </div>
            <footer className="dialog-foot">
                <Verdict answer={answer} reversed={reversed ?? null} />
                <Button
                    look="primary"
                    disabled={!found?.drawable || reversed !== undefined}
                    onClick={() => onTake(equation, surfaceValue(surface, now))}
                >
                    {surfaceText("take")}
                </Button>
            </footer>
        </>
    );
}

interface MethodProps {
    value: string | null;
    onChange: (method: string) => void;
}

/* How the equation is found, by the schema; nothing where a server has no choice. */
function Method({ value, onChange }: MethodProps) {
    const param = useDocument(({ schema }) => schema.implicitize[0]);
    if (param === undefined) {
        return null;
    }
    return (
        <div className="parametric-method">
            <span>{paramTitle(param)}</span>
            <Select
                value={value ?? String(param.default)}
                label={paramTitle(param)}
                describedBy="parametric-method"
                options={param.choices.map((choice) => ({ value: choice, label: choice }))}
                onChange={onChange}
            />
            <p id="parametric-method">{param.doc}</p>
        </div>
    );
}

interface RangeProps {
    letter: string;
    range: SurfaceRange;
    onChange: (range: SurfaceRange) => void;
    /* The end of a gesture; absent: as each of its steps. */
    onCommit?: (range: SurfaceRange) => void;
    onCancel?: () => void;
}

const BOUND = numberParam("bound", { step: 0.1 });
const ignore = (): void => undefined;

/* [low] ≤ s ≤ [high] */
export function Range({ letter, range: [low, high], onChange, onCommit, onCancel }: RangeProps) {
    const bound = (label: string, value: number, next: (value: number) => SurfaceRange) => (
        <NumberField
            param={BOUND}
            label={label}
            value={value}
            fallback={value}
            onInput={(value) => onChange(next(value))}
            onCommit={(value) => (onCommit ?? onChange)(next(value))}
            onCancel={onCancel ?? ignore}
            onRefuse={ignore}
        />
    );
    return (
        <div className="parametric-range">
            {bound(surfaceText("from", { letter }), low, (value) => [value, high])}
            <span>≤ {letter} ≤</span>
            {bound(surfaceText("to", { letter }), high, (value) => [low, value])}
        </div>
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
function Verdict({ answer, reversed }: { answer: Answer | null; reversed: string | null }) {
    const { found = null, problem = null } = answer ?? {};
    const place = problem?.place.replace("/", "");
    return (
        <p
            role="status"
            data-bad={
                problem !== null || found?.drawable === false || reversed !== null || undefined
            }
        >
            {problem !== null && `${place ? `${place}: ` : ""}${problem.message}`}
            {found !== null && surfaceText("found", { degree: found.degree, terms: found.terms })}
            {found?.drawable === false && ` ${surfaceText("large", { why: found.why })}`}
            {answer === null && surfaceText("busy")}
            {reversed !== null && ` ${surfaceText("range", { letter: reversed })}`}
        </p>
    );
}
