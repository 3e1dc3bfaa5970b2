/* SPDX-License-Identifier: MIT */
/* The parametric surface that an equation was found for. The server proves it again whenever one of
 * the two changes; the badge says what it found. Without an equation beside it the surface is what
 * the node is: Patches.tsx. */
import { CircleCheck, LoaderCircle, TriangleAlert } from "lucide-react";
import { useEffect, useMemo, useState } from "react";
import { type Proof, verify } from "../../link/surfaceRest.ts";
import { paramAt } from "../../model/document.ts";
import type { JsonObject } from "../../model/json.ts";
import { multiEdit } from "../../model/multiEdit.ts";
import { type Value, valueIn } from "../../model/schema.ts";
import {
    readSurface,
    type Surface,
    type SurfaceRevision,
    type SurfaceValue,
} from "../../model/surface.ts";
import { keepPatch } from "../../model/trim.ts";
import { useDocument, useEditor } from "../state.ts";
import { Button } from "../widgets/Button.tsx";
import { FromParametric } from "./Parametric.tsx";
import { PatchesField } from "./Patches.tsx";
import { coverageSentence, surfaceText } from "./surfaceTexts.ts";
import type { FieldProps } from "./types.ts";
import "./fields.css";

/* A pause in changes after which the server is asked. */
const ASK_MS = 300;

interface Props extends FieldProps<SurfaceValue, SurfaceRevision> {
    place: string;
}

export default function SurfaceField(props: Props) {
    const { place } = props;
    const proved = useDocument(
        ({ schema, document }) =>
            document !== null && paramAt(schema, document, beside(place, "equation")) !== null,
    );
    const node = /^\/nodes\/([^/]+)\/params\//.exec(place)?.[1];
    return proved || node === undefined ? (
        <Proved {...props} />
    ) : (
        <PatchesField {...props} node={node} />
    );
}

const beside = (place: string, name: string): string => place.replace(/[^/]+$/, name);

function Proved({ label, value, place, mixed }: Props) {
    const { link, stores } = useEditor();
    const [open, setOpen] = useState(false);
    const surface = readSurface(value);
    const size = useClipSize(place);
    const take = (equation: string, found: SurfaceValue): void => {
        const { schema, document } = stores.document.getState();
        const { selection } = stores.view.getState();
        const set = (at: string, next: Value) =>
            document ? multiEdit(schema, document, selection, at, next) : [];
        setOpen(false);
        link.edit([...set(beside(place, "equation"), equation), ...set(place, found)], {
            label: surfaceText("edit"),
        });
    };
    return (
        // biome-ignore lint/a11y/useSemanticElements: a fieldset brings a look and a legend of its own
        <div
            className="surface"
            role="group"
            aria-label={label}
            data-empty={surface === null || undefined}
        >
            {surface !== null && !mixed && <Summary surface={surface} />}
            <div className="surface-foot">
                {surface !== null && !mixed && <Badge place={place} />}
                <Button look="outline" className="equation-from" onClick={() => setOpen(true)}>
                    {surfaceText(surface === null ? "open" : "change")}
                </Button>
            </div>
            <FromParametric
                open={open}
                start={surface}
                size={size}
                onTake={take}
                onClose={() => setOpen(false)}
            />
        </div>
    );
}

/* Of the box that clips the node; null: a ball does. */
function useClipSize(place: string): readonly number[] | null {
    const text = useDocument(({ schema, document }) => {
        const of = (name: string) => {
            const row = document && paramAt(schema, document, beside(place, name));
            return row ? valueIn(row.values, row.param) : null;
        };
        return JSON.stringify(of("clip") === "box" ? of("size") : null);
    });
    return useMemo(() => JSON.parse(text), [text]);
}

function Summary({ surface }: { surface: Surface }) {
    const { texts, ranges } = surface;
    const lines = Object.entries(texts).map(([part, text]) => `${part} = ${text}`);
    const bounds = Object.entries(ranges).map(([letter, [low, high]]) =>
        `${low} ≤ ${letter} ≤ ${high}`.replaceAll("-", "−"),
    );
    return (
        <pre className="surface-texts">
            {lines.join("\n")}
            <span>{`\n${bounds.join(", ")}`}</span>
        </pre>
    );
}

/* --- the badge --- */

/* null: it is being checked. */
function useProof(place: string): Proof | null {
    const { rest } = useEditor();
    const body = useDocument(({ schema, document }) => {
        const values = (document && paramAt(schema, document, place)?.values) ?? {};
        const { mode: _mode, thickness: _thickness, ...asked } = values;
        return JSON.stringify(asked);
    });
    const params = useMemo(() => JSON.parse(body) as JsonObject, [body]);
    const [proof, setProof] = useState<Proof | null>(null);
    useEffect(() => {
        const request = new AbortController();
        const tell = (next: Proof): void => {
            if (!request.signal.aborted) {
                setProof(next);
            }
        };
        setProof(null);
        const timer = setTimeout(() => {
            verify(rest.request, params, request.signal).then(tell, (problem) =>
                tell({ verdict: "", reason: String(problem.message ?? problem), coverage: null }),
            );
        }, ASK_MS);
        return () => {
            clearTimeout(timer);
            request.abort();
        };
    }, [rest, params]);
    return proof;
}

function Badge({ place }: { place: string }) {
    const proof = useProof(place);
    const verified = proof?.verdict === "verified";
    const state = proof === null ? "busy" : verified ? "verified" : "unverified";
    const Icon = { busy: LoaderCircle, verified: CircleCheck, unverified: TriangleAlert }[state];
    const coverage = proof?.coverage ?? null;
    return (
        <div className="surface-told">
            <p className="surface-badge" role="status" data-proof={state}>
                <Icon size={14} aria-hidden="true" />
                <span>
                    {surfaceText(`proof.${state}`, { reason: proof?.reason ?? "" })}
                    {coverage && `. ${coverageSentence(coverage)}`}
                </span>
            </p>
            {coverage !== null && coverage.share < 1 && <Trim place={place} />}
        </div>
    );
}

/* What else the equation has goes away in one edit. */
function Trim({ place }: { place: string }) {
    const { link } = useEditor();
    const node = /^\/nodes\/([^/]+)\//.exec(place)?.[1] ?? "";
    const ops = useDocument(({ schema, document }) =>
        JSON.stringify(document && keepPatch(schema, document, node)),
    );
    return ops === "null" ? null : (
        <Button
            look="outline"
            className="equation-from"
            onClick={() => link.edit(JSON.parse(ops), { label: surfaceText("trimEdit") })}
        >
            {surfaceText("trim")}
        </Button>
    );
}
