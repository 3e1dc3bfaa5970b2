/* SPDX-License-Identifier: MIT */
/* The equation of a parametric surface: three expressions in two parameters; the server finds the
 * equation while they are typed, and proves it. */
import { useEffect, useState } from "react";
import type { RestError } from "../../link/rest.ts";
import type { Change } from "../../model/multiEdit.ts";
import { numberParam } from "../../model/schema.ts";
import {
    PARTS,
    rangesOf,
    type Surface,
    type SurfaceRange,
    type SurfaceValue,
    surfaceValue,
} from "../../model/surface.ts";
import { tidy } from "../../model/units.ts";
import { lazyPart } from "../lazy.tsx";
import { paramTitle } from "../names.ts";
import { useDocument } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { Dialog } from "../widgets/Dialog.tsx";
import { Select } from "../widgets/Select.tsx";
import { NumberField } from "./Number.tsx";
import { CancelSearch, searchText } from "./SearchState.tsx";
import { coverageSentence, surfaceText } from "./surfaceTexts.ts";
import { type Search, useEquation } from "./useEquation.ts";
import "./fields.css";

const Typeset = lazyPart(() => import("./Typeset.tsx"));

/* Whitney's umbrella. */
const FIRST: Surface = { texts: { x: "s*t", y: "s", z: "t^2" }, ranges: {} };

interface Props {
    open: boolean;
    /* What the node has; null: nothing yet. */
    start: Surface | null;
    /* Of the box that clips it; null: it has none, and how much of it is covered is not told. */
    size: readonly number[] | null;
    onTake: (equation: string, surface: SurfaceValue) => void;
    onClose: () => void;
}

export function FromParametric({ open, start, size, onTake, onClose }: Props) {
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
                size={size}
                onChange={setDraft}
                onTake={(equation, surface) => {
                    setDraft(null);
                    onTake(equation, surface);
                }}
            />
        </Dialog>
    );
}

interface SheetProps {
    surface: Surface;
    size: readonly number[] | null;
    onChange: (surface: Surface) => void;
    onTake: (equation: string, surface: SurfaceValue) => void;
}

function Sheet({ surface, size, onChange, onTake }: SheetProps) {
    const { texts } = surface;
    /* null: as the server does. */
    const [method, setMethod] = useState<string | null>(null);
    const search = useEquation(texts, method, size === null ? {} : rangesOf(surface), size);
    const { found } = search;
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
                        problem={search.problem?.place === `/${part}` ? search.problem : null}
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
                <Verdict search={search} reversed={reversed ?? null} />
                <CancelSearch search={search} />
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
            <span className="form-label">{paramTitle(param)}</span>
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

/* How the same range of another surface follows. */
export type RangeChange = (own: SurfaceRange) => SurfaceRange;

type SendRange = (range: SurfaceRange, change: RangeChange) => void;

interface RangeProps {
    letter: string;
    range: SurfaceRange;
    mixed?: boolean;
    onChange: SendRange;
    /* The end of a gesture; absent: as each of its steps. */
    onCommit?: SendRange;
    onCancel?: () => void;
}

const BOUND = numberParam("bound", { step: 0.1 });
const ignore = (): void => undefined;

function withBound([low, high]: SurfaceRange, index: 0 | 1, x: number): SurfaceRange {
    return index === 0 ? [x, high] : [low, x];
}

/* [low] ≤ s ≤ [high] */
export function Range({ letter, range, mixed, onChange, onCommit, onCancel }: RangeProps) {
    const bound = (label: string, index: 0 | 1) => {
        const put = (send: SendRange) => (x: number, change?: Change) =>
            send(withBound(range, index, x), (own) =>
                withBound(own, index, change ? tidy(change.by(own[index])) : x),
            );
        return (
            <NumberField
                param={BOUND}
                label={label}
                value={range[index]}
                fallback={range[index]}
                mixed={mixed ? "1" : ""}
                onInput={put(onChange)}
                onCommit={put(onCommit ?? onChange)}
                onCancel={onCancel ?? ignore}
                onRefuse={ignore}
            />
        );
    };
    return (
        <div className="parametric-range">
            {bound(surfaceText("from", { letter }), 0)}
            <span>≤ {letter} ≤</span>
            {bound(surfaceText("to", { letter }), 1)}
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
            <Typeset text={text} form="expression" problem={problem} tells={false} />
        </div>
    );
}

/* What was proved, or why there is no equation. */
function Verdict({ search, reversed }: { search: Search; reversed: string | null }) {
    const { found, problem } = search;
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
            {found?.coverage && ` ${coverageSentence(found.coverage)}`}
            {found?.drawable === false && ` ${surfaceText("large", { why: found.why })}`}
            {searchText(search)}
            {reversed !== null && ` ${surfaceText("range", { letter: reversed })}`}
        </p>
    );
}
