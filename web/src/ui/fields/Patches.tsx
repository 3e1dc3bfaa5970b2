/* SPDX-License-Identifier: MIT */
/* The surface of a node that is drawn as it is written: three expressions and two ranges. The
 * picture follows what is typed. Meanwhile the server looks for the equation, which may take the
 * surface's place in one edit. */
import { useMemo } from "react";
import { qualityOf } from "../../link/qualityRest.ts";
import { paramAt } from "../../model/document.ts";
import type { Json } from "../../model/json.ts";
import { valueIn, wordsIn } from "../../model/schema.ts";
import {
    LETTERS,
    lettersOf,
    NO_SURFACE,
    PARTS,
    type PartTexts,
    rangesOf,
    readSurface,
    type Surface,
    type SurfaceRange,
    type SurfaceRevision,
    type SurfaceValue,
    surfaceValue,
    withNumbers,
    withRange,
    withText,
} from "../../model/surface.ts";
import { lazyPart } from "../lazy.tsx";
import { isLetter } from "../names.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { Range, type RangeChange } from "./Parametric.tsx";
import { CancelSearch, searchText } from "./SearchState.tsx";
import { coverageSentence, surfaceText } from "./surfaceTexts.ts";
import { useTypedText } from "./typedText.ts";
import type { FieldProps } from "./types.ts";
import { useEquation } from "./useEquation.ts";
import "./fields.css";

const Typeset = lazyPart(() => import("./Typeset.tsx"));
const QualityBadge = lazyPart(() => import("./Quality.tsx"));

/* As they follow one another in `mixed`. */
const NAMES: readonly string[] = [...PARTS, ...LETTERS];

interface Props extends FieldProps<SurfaceValue, SurfaceRevision> {
    place: string;
    node: string;
}

export function PatchesField(props: Props) {
    const { label, value, place, node, mixed = "", onInput, onCommit, onCancel } = props;
    const surface = readSurface(value) ?? NO_SURFACE;
    const alone = useView(({ selection }) => selection.length === 1);
    const letters = lettersOf(surface);
    const ranges = rangesOf(surface);
    const isMixed = (name: string): boolean => mixed.charAt(NAMES.indexOf(name)) === "1";
    const put = (send: typeof onInput, part: keyof PartTexts) => (text: string) => {
        const revise: SurfaceRevision = (own) => withText(own, part, text);
        send(revise(value), revise);
    };
    const putRange =
        (send: typeof onInput, letter: string) => (range: SurfaceRange, change: RangeChange) =>
            send(
                withRange(value, letter, () => range),
                (own) => withRange(own, letter, change),
            );
    return (
        // biome-ignore lint/a11y/useSemanticElements: a fieldset brings a look and a legend of its own
        <div className="patches" role="group" aria-label={label}>
            {PARTS.map((part) => (
                <PartField
                    key={part}
                    label={surfaceText("part", { label, part })}
                    part={part}
                    place={`${place}/${part}`}
                    text={surface.texts[part]}
                    mixed={isMixed(part)}
                    onInput={put(onInput, part)}
                    onCommit={put(onCommit, part)}
                    onCancel={onCancel}
                />
            ))}
            {letters.map((letter) => (
                <Range
                    key={letter}
                    letter={letter}
                    range={ranges[letter] ?? [0, 0]}
                    mixed={isMixed(letter)}
                    onChange={(range, change) =>
                        range[0] < range[1] && putRange(onInput, letter)(range, change)
                    }
                    onCommit={(range, change) =>
                        range[0] < range[1] ? putRange(onCommit, letter)(range, change) : onCancel()
                    }
                    onCancel={onCancel}
                />
            ))}
            {alone && <QualityBadge node={node} place={place} />}
            {alone && readSurface(value) !== null && (
                <Equation node={node} place={place} surface={surface} letters={letters} />
            )}
        </div>
    );
}

/* --- a part --- */

interface PartFieldProps {
    label: string;
    part: string;
    place: string;
    text: string;
    mixed: boolean;
    onInput: (text: string) => void;
    onCommit: (text: string) => void;
    onCancel: () => void;
}

function PartField({ label, part, place, mixed, ...typed }: PartFieldProps) {
    const { shown, listeners } = useTypedText({ place, mixed, ...typed });
    const problem = useDocument(({ problems }) => problems.get(place) ?? null);
    return (
        <div className="parametric-part">
            <span aria-hidden="true">{part} =</span>
            <input
                className="text-field"
                aria-label={label}
                value={shown}
                placeholder={mixed ? t("field.mixed") : undefined}
                spellCheck={false}
                autoComplete="off"
                aria-invalid={problem !== null || undefined}
                {...listeners}
            />
            <Typeset text={shown} form="expression" problem={problem} />
        </div>
    );
}

/* --- its equation --- */

/* The texts with the values of the node's own letters. */
function useProvable(place: string, texts: PartTexts): PartTexts {
    const numbers = useDocument(({ schema, document }) => {
        const values = new Map<string, unknown>();
        for (const word of PARTS.flatMap((part) => wordsIn(texts[part]))) {
            const own = document && paramAt(schema, document, place.replace(/[^/]+$/, word));
            if (own && isLetter(own.param)) {
                values.set(word, valueIn(own.values, own.param));
            }
        }
        return JSON.stringify(Object.fromEntries(values));
    });
    const { x, y, z } = texts;
    return useMemo(() => withNumbers({ x, y, z }, JSON.parse(numbers)), [x, y, z, numbers]);
}

interface EquationProps {
    node: string;
    place: string;
    surface: Surface;
    letters: readonly string[];
}

/* What was proved and the way to it, or why there is no equation. */
function Equation({ node, place, surface, letters }: EquationProps) {
    const { link, rest, stores } = useEditor();
    const texts = useProvable(place, surface.texts);
    const search = useEquation(texts, null, rangesOf(surface));
    const { found, problem } = search;
    const reason = problem?.message ?? (found?.drawable === false ? found.why : null);
    const make = async (equation: string): Promise<void> => {
        const { scene } = stores.document.getState();
        const quality = await qualityOf(
            rest,
            scene ?? "",
            node,
            new AbortController().signal,
        ).catch(() => null);
        const set = (at: string, next: Json) => ({
            op: "set" as const,
            at: `/nodes/${node}/${at}`,
            value: next,
        });
        link.edit(
            [
                set("type", "implicit"),
                set("params/equation", `${equation} = 0`),
                set("params/parametric", surfaceValue({ ...surface, texts }, letters)),
                set("params/mode", "sheet"),
                ...(quality ? [set("params/size", sizeAround(quality.box))] : []),
            ],
            { label: surfaceText("makeEdit") },
        );
    };
    return (
        <div className="patches-equation">
            <p role="status" data-bad={reason !== null || undefined}>
                {searchText(search)}
                {found?.drawable === true &&
                    surfaceText("found", { degree: found.degree, terms: found.terms })}
                {found?.drawable === true &&
                    found.coverage &&
                    ` ${coverageSentence(found.coverage)}`}
                {reason !== null && surfaceText("none", { reason: sentence(reason) })}
            </p>
            <CancelSearch search={search} />
            {found?.drawable === true && (
                <Button
                    look="outline"
                    className="equation-from"
                    onClick={() => void make(found.equation)}
                >
                    {surfaceText("make")}
                </Button>
            )}
        </div>
    );
}

const sentence = (text: string): string => (/[.!?]$/.test(text) ? text : `${text}.`);

/* Full lengths of a box about the origin, a little larger. */
function sizeAround(box: readonly (readonly number[])[]): number[] {
    return [0, 1, 2].map((i) => {
        const most = Math.max(...box.map((corner) => Math.abs(corner[i] ?? 0)));
        return Number((2.04 * most).toPrecision(3)) || 1;
    });
}
