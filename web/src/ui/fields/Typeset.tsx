/* SPDX-License-Identifier: MIT */
/* What is typed, typeset below it. While it cannot be read, the last that could stays, dimmed, and
 * each fault is marked and told. */
import { useEffect, useLayoutEffect, useMemo, useRef, useState } from "react";
import { type Typeset as Answer, type TypesetForm, typeset } from "../../link/typesetRest.ts";
import { type Fault, messagesOf } from "../../model/faults.ts";
import { useEditor } from "../state.ts";
import { Mark } from "./Mark.tsx";
import { mathmlNode } from "./mathml.ts";
import "./typeset.css";

/* A pause in typing after which the server is asked. */
const ASK_MS = 120;
const LABEL = "typeset";

interface Props {
    text: string;
    form: TypesetForm;
    /* What is known to be wrong with it otherwise, if that has a place. */
    problem: Partial<Fault> | { line: number | null; column: number | null } | null;
    /* Whether one fault alone is told here. */
    tells?: boolean;
}

interface Told {
    /* Last read. */
    readonly lines: readonly string[];
    /* Of `text`. */
    readonly faults: readonly Fault[];
    readonly text: string;
}

const NOTHING: Told = { lines: [], faults: [], text: "" };

const next = ({ lines }: Told, text: string, answer: Answer): Told => ({
    lines: answer.lines.length > 0 ? answer.lines : lines,
    faults: answer.faults,
    text,
});

function useTypeset(text: string, form: TypesetForm): Told {
    const { rest } = useEditor();
    const [told, setTold] = useState(NOTHING);
    useEffect(() => {
        const request = new AbortController();
        if (text.trim() === "") {
            setTold(NOTHING);
            return;
        }
        const timer = setTimeout(() => {
            typeset(rest.request, text, form, request.signal).then(
                (answer) => {
                    if (!request.signal.aborted) {
                        setTold((before) => next(before, text, answer));
                    }
                },
                () => undefined /* what was read last stays */,
            );
        }, ASK_MS);
        return () => {
            clearTimeout(timer);
            request.abort();
        };
    }, [rest, text, form]);
    return told;
}

export default function Typeset({ text, form, problem, tells = true }: Props) {
    const told = useTypeset(text, form);
    const isNow = told.text === text;
    const known = problem?.line
        ? [{ line: problem.line, column: problem.column ?? 1, message: "" }]
        : [];
    const [faults, of] = told.faults.length > 0 ? [told.faults, told.text] : [known, text];
    const messages = messagesOf(told.faults);
    return (
        <>
            {faults.length > 0 && <Mark text={of} faults={faults} />}
            {messages.length > (tells ? 0 : 1) && (
                <ul className="equation-faults" role="status">
                    {messages.map((message) => (
                        <li key={message}>{message}</li>
                    ))}
                </ul>
            )}
            <Lines lines={told.lines} isOld={!isNow || told.faults.length > 0} />
        </>
    );
}

function Lines({ lines, isOld }: { lines: readonly string[]; isOld: boolean }) {
    const box = useRef<HTMLDivElement>(null);
    const nodes = useMemo(() => lines.map(mathmlNode), [lines]);
    const [scrolls, setScrolls] = useState(false);
    // biome-ignore lint/correctness/useExhaustiveDependencies: measured anew with each text
    useLayoutEffect(() => {
        const {
            scrollWidth = 0,
            clientWidth = 0,
            scrollHeight = 0,
            clientHeight = 0,
        } = box.current ?? {};
        setScrolls(scrollWidth > clientWidth || scrollHeight > clientHeight);
    }, [nodes]);
    return nodes.length === 0 ? null : (
        // biome-ignore lint/a11y/useSemanticElements: a fieldset brings a look and a legend of its own
        <div
            ref={box}
            className="typeset"
            /* No landmark: a surface has three. */
            role="group"
            aria-label={LABEL}
            data-old={isOld || undefined}
            /* Scrolled by keys. */
            tabIndex={scrolls ? 0 : undefined}
        >
            {nodes.map((node, i) => (
                // biome-ignore lint/suspicious/noArrayIndexKey: lines have no other name
                <div key={i} className="typeset-line">
                    {node}
                </div>
            ))}
        </div>
    );
}
