/* SPDX-License-Identifier: MIT */
/* The reduced basis, the elimination ideal and a division by the basis. */
import { Copy } from "lucide-react";
import { useState } from "react";
import { type Answer, type Division, type Element, splitLeading } from "../../model/basis.ts";
import { Button } from "../widgets/Button.tsx";
import { Polynomial } from "./Polynomial.tsx";
import { fill, TEXTS } from "./texts.ts";

export function Result({ answer }: { answer: Answer }) {
    const { basis, elimination, division } = answer;
    return (
        <>
            {elimination && (
                <section aria-label={TEXTS.elimination}>
                    <h3>{TEXTS.elimination}</h3>
                    <Elements elements={elimination} />
                    <p>
                        {elimination.length === 0
                            ? TEXTS.nothing
                            : elimination.length === 1
                              ? TEXTS.principal
                              : TEXTS.notPrincipal}
                    </p>
                </section>
            )}
            <section aria-label={TEXTS.basis}>
                <h3>
                    {TEXTS.basis}
                    <CopyButton text={basis.map(({ text }) => text).join("\n")} />
                </h3>
                <Elements elements={basis} />
            </section>
            {division && <Divided division={division} />}
        </>
    );
}

function Elements({ elements }: { elements: readonly Element[] }) {
    return (
        <ol className="workbench-elements" start={0}>
            {elements.map((element) => {
                const [leading, rest] = splitLeading(element.text);
                return (
                    <li key={element.leading}>
                        <strong>
                            <Polynomial text={leading} />
                        </strong>
                        <Polynomial text={rest} />
                    </li>
                );
            })}
        </ol>
    );
}

function CopyButton({ text }: { text: string }) {
    const [copied, setCopied] = useState(false);
    return (
        <Button
            icon={<Copy size={14} />}
            onClick={() => void navigator.clipboard.writeText(text).then(() => setCopied(true))}
        >
            {copied ? TEXTS.copied : TEXTS.copy}
        </Button>
    );
}

function Divided({ division: { scale, quotients, rest } }: { division: Division }) {
    const of = scale === "1" ? "" : ` ${fill(TEXTS.scaled, { scale })}`;
    return (
        <section aria-label={TEXTS.quotients}>
            <h3>
                {TEXTS.quotients}
                {of}
            </h3>
            <ol className="workbench-elements" start={0}>
                {quotients.map((text, i) => (
                    // biome-ignore lint/suspicious/noArrayIndexKey: the i-th belongs to element i
                    <li key={i}>
                        <Polynomial text={text} />
                    </li>
                ))}
            </ol>
            <h3>{TEXTS.rest}</h3>
            <p className="workbench-rest">
                <Polynomial text={rest} />
            </p>
        </section>
    );
}
