/* SPDX-License-Identifier: MIT */
/* The workbench: an ideal of polynomials, its Groebner basis, and how Buchberger's algorithm finds
 * it, pair by pair. */
import { useState } from "react";
import { type Asked, type Basis, IDEALS, isOver } from "../../model/basis.ts";
import type { Param } from "../../model/schema.ts";
import { Mark } from "../fields/Mark.tsx";
import { fieldFor } from "../form.tsx";
import { paramTitle } from "../names.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { Dialog } from "../widgets/Dialog.tsx";
import { Select } from "../widgets/Select.tsx";
import { Result } from "./Result.tsx";
import { Steps } from "./Steps.tsx";
import { fill, TEXTS } from "./texts.ts";
import { useBasis } from "./useBasis.ts";
import "./algebra.css";

export default function Workbench() {
    const { stores } = useEditor();
    const open = useView((view) => view.popup === "groebner");
    const [asked, setAsked] = useState<Asked>(IDEALS[0]?.asked ?? {});
    return (
        <Dialog
            open={open}
            title={TEXTS.title}
            wide
            closeLabel={t("close")}
            onClose={() => stores.view.setState({ popup: null })}
        >
            <Sheet asked={asked} onChange={setAsked} />
        </Dialog>
    );
}

interface Props {
    asked: Asked;
    onChange: (asked: Asked) => void;
}

function Sheet({ asked, onChange }: Props) {
    const { basis, make, cancel } = useBasis();
    const over = basis === null || isOver(basis);
    const untold = basis === null || (basis.failure !== null && basis.steps.length === 0);
    return (
        <>
            <div className="workbench">
                <Question asked={asked} basis={basis} onChange={onChange} />
                <div className="workbench-told">
                    {untold && <p className="workbench-empty">{TEXTS.empty}</p>}
                    {basis?.answer && <Result answer={basis.answer} />}
                    {basis && basis.failure === null && <Steps steps={basis.steps} />}
                </div>
            </div>
            <footer className="dialog-foot">
                <State basis={basis} />
                {over ? (
                    <Button look="primary" onClick={() => make(asked)}>
                        {TEXTS.make}
                    </Button>
                ) : (
                    <Button look="outline" onClick={cancel}>
                        {TEXTS.cancel}
                    </Button>
                )}
            </footer>
        </>
    );
}

/* The polynomials are marked themselves; other fields are named. */
function sayWhere(place: string, message: string): string {
    const name = place.replace("/", "");
    return name === "" || name === "generators" ? message : `${name}: ${message}`;
}

function State({ basis }: { basis: Basis | null }) {
    const waiting = basis?.steps.at(-1)?.waiting ?? 0;
    const failure = basis?.failure ?? null;
    const texts: Record<Basis["state"], string> = {
        waiting: TEXTS.waiting,
        running: fill(TEXTS.running, { count: waiting }),
        done: fill(TEXTS.done, { ms: Math.max(1, Math.round(basis?.answer?.ms ?? 0)) }),
        failed: failure ? sayWhere(failure.place, failure.message) : "",
        cancelled: TEXTS.cancelled,
    };
    return (
        <p role="status" data-state={basis?.state} data-bad={failure !== null || undefined}>
            {basis ? texts[basis.state] : ""}
        </p>
    );
}

function Question({ asked, basis, onChange }: Props & { basis: Basis | null }) {
    const params = useDocument(({ schema }) => schema.ideal);
    const generators = String(asked.generators ?? "");
    const failure = basis?.failure ?? null;
    const wrong = failure?.place === "/generators" ? failure : null;
    return (
        <div className="workbench-form">
            <Select
                value=""
                label={TEXTS.examples}
                options={[
                    { value: "", label: TEXTS.examples },
                    ...IDEALS.map(({ name }) => ({ value: name, label: name })),
                ]}
                onChange={(chosen) => {
                    const found = IDEALS.find(({ name }) => name === chosen);
                    onChange(found?.asked ?? asked);
                }}
            />
            <textarea
                className="workbench-generators"
                aria-label={TEXTS.generators}
                aria-invalid={wrong !== null || undefined}
                value={generators}
                rows={6}
                spellCheck={false}
                onChange={({ target }) => onChange({ ...asked, generators: target.value })}
            />
            {wrong?.line && (
                <Mark
                    text={generators}
                    faults={[{ line: wrong.line, column: wrong.column ?? 1 }]}
                />
            )}
            {params
                .filter(({ name }) => name !== "generators")
                .map((param) => (
                    <Row
                        key={param.name}
                        param={param}
                        value={asked[param.name] ?? param.default}
                        onChange={(value) => onChange({ ...asked, [param.name]: value })}
                    />
                ))}
        </div>
    );
}

interface RowProps {
    param: Param;
    value: unknown;
    onChange: (value: string | number) => void;
}

const ignore = (): void => undefined;

function Row({ param, value, onChange }: RowProps) {
    /* A polynomial of one line is a text. */
    const type = param.type === "equation" ? "text" : param.type;
    const props = {
        label: paramTitle(param),
        value: value as never,
        fallback: param.default as never,
        onInput: onChange as never,
        onCommit: onChange as never,
        onCancel: ignore,
        onRefuse: ignore,
    };
    return (
        <div className="form-row" data-param={param.name}>
            <span className="form-label" title={param.doc}>
                {paramTitle(param)}
            </span>
            <div className="form-field">{fieldFor(type)(param, props, "")}</div>
        </div>
    );
}
