/* SPDX-License-Identifier: MIT */
/* Code beside the picture: what is typed goes into the document after a pause, the picture keeps
 * the last that compiled, and what does not is marked where it stands. */
import { CircleAlert, CircleCheck, X } from "lucide-react";
import { useEffect, useRef, useState } from "react";
import type { Gesture } from "../../link/link.ts";
import { declaredBy, findResource, nodeLabel, paramAt } from "../../model/document.ts";
import type { Problem } from "../../model/operation.ts";
import { nodeOfPlace, resourceOfPlace } from "../../model/places.ts";
import { isGivenUp, TOO_SLOW } from "../../model/problems.ts";
import type { Param } from "../../model/schema.ts";
import { NEW_NODE_CODE } from "../../model/templates.ts";
import { checkText } from "../../model/values.ts";
import type { Editor } from "../editor.ts";
import { showPlace } from "../insertions.ts";
import { keptOf, useRefusal } from "../kept.ts";
import { useDocument, useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { Button, IconButton } from "../widgets/Button.tsx";
import { useLeftFocus } from "../widgets/leftFocus.ts";
import { Tip } from "../widgets/Tip.tsx";
import type { CodeEditor } from "./mount.ts";
import "./code.css";

/* A pause in typing after which the text is sent, and one after which a new undo step begins. */
const SEND_MS = 300;
const STEP_MS = 2000;

export default function CodePanel({ place }: { place: string }) {
    const editor = useEditor();
    const known = useDocument(
        ({ document, schema }) => document === null || paramAt(schema, document, place) !== null,
    );
    useEffect(() => {
        if (!known) {
            editor.stores.view.setState({ code: null });
        }
    }, [editor, known]);
    return <Panel key={place} place={place} />;
}

function useText(place: string): string {
    return useDocument(({ document, schema }) => {
        const found = document && paramAt(schema, document, place);
        const value = found?.values[found.param.name];
        return typeof value === "string" ? value : "";
    });
}

const NO_PARAMS: readonly Param[] = [];

/* What the code may name besides its own. */
function useDeclared(place: string): readonly Param[] {
    return useDocument(({ document, schema }) => {
        const owner = resourceOfPlace(place);
        if (document === null || (owner?.list !== "primitives" && owner?.list !== "shaders")) {
            return NO_PARAMS;
        }
        const resource = findResource(document, owner.list, owner.name);
        return declaredBy(schema, owner.list, resource);
    });
}

function Panel({ place }: { place: string }) {
    const { stores } = useEditor();
    const text = useText(place);
    const declared = useDeclared(place);
    const found = useDocument(({ problems }) => problems.get(place) ?? null);
    const { element, code, waiting, refused } = useCode(place, text);
    const problem = refused ?? found;
    useEffect(() => code?.setNames(declared.map(({ name }) => name)), [code, declared]);
    useEffect(() => {
        const { line, column = 1, message = "" } = problem ?? {};
        code?.setMark(line === undefined ? null : { line, column, message });
    }, [code, problem]);
    return (
        <section
            ref={useLeftFocus()}
            className="code-panel"
            aria-label={t("code.title")}
            data-testid="code"
            data-place={place}
            data-waiting={waiting || undefined}
            data-region={t("code.title")}
            tabIndex={-1}
            onKeyDown={(event) => {
                /* Escape lets Tab leave the editor; it closes nothing here. */
                if (event.key === "Escape") {
                    event.stopPropagation();
                }
            }}
        >
            <header className="code-head">
                <Title place={place} />
                <State problem={problem} waiting={waiting} onShow={code} />
                <span className="bar-space" />
                <IconButton
                    title={t("close")}
                    data-size="s"
                    onClick={() => stores.view.setState({ code: null })}
                >
                    <X size={15} />
                </IconButton>
            </header>
            <Names declared={declared} place={place} />
            <div ref={element} className="code-text" data-loading={code === null || undefined} />
            {text === "" && code !== null && !waiting && refused === null && (
                <div className="code-start">
                    <Button look="outline" onClick={() => start(code)}>
                        {t("code.template")}
                    </Button>
                </div>
            )}
            {problem && <Fault problem={problem} code={code} />}
        </section>
    );
}

/* An example to begin with, as if it had been typed. */
function start(code: CodeEditor): void {
    code.insert(NEW_NODE_CODE);
    code.focus();
}

function Title({ place }: { place: string }) {
    const editor = useEditor();
    const name = useDocument(({ document }) => {
        const node = document?.nodes.get(nodeOfPlace(place) ?? "");
        return node ? nodeLabel(node) : (resourceOfPlace(place)?.name ?? "");
    });
    const list = resourceOfPlace(place)?.list;
    return (
        <h2 className="code-title">
            <button
                type="button"
                className="link-button ellipsis"
                onClick={() => showPlace(editor, place, false)}
            >
                {name}
            </button>
            <span className="code-kind">
                {t(list === "shaders" ? "code.shader" : "code.function")}
            </span>
        </h2>
    );
}

interface StateProps {
    problem: Problem | null;
    waiting: boolean;
    onShow: CodeEditor | null;
}

function State({ problem, waiting, onShow }: StateProps) {
    if (waiting) {
        return <span className="code-state">{t("code.typing")}</span>;
    }
    if (problem === null) {
        return (
            <span className="code-state" data-good="">
                <CircleCheck size={14} aria-hidden="true" />
                {t("code.good")}
            </span>
        );
    }
    return (
        <Tip text={problem.message}>
            <button
                type="button"
                className="code-state"
                data-bad=""
                onClick={() => onShow?.goTo(problem.line ?? 1, problem.column ?? 1)}
            >
                <CircleAlert size={14} aria-hidden="true" />
                {badText(problem)}
            </button>
        </Tip>
    );
}

/* Where the error is; of what is too slow or crashed nobody knows a line. */
function badText({ code, line }: Problem): string {
    if (line !== undefined) {
        return t("code.errorLine", { line });
    }
    return t(code === TOO_SLOW ? "code.tooSlow" : isGivenUp(code) ? "code.crashed" : "code.error");
}

/* What the code has besides what it makes itself. */
function Names({ declared, place }: { declared: readonly Param[]; place: string }) {
    const given = resourceOfPlace(place)?.list === "shaders" ? ["properties"] : ["p"];
    return (
        <p className="code-names">
            <span>{t("code.has")}</span>
            {given.map((name) => (
                <code key={name}>{name}</code>
            ))}
            {declared.map(({ name, type, doc }) => (
                <code key={name} className="code-declared" title={doc || type}>
                    {name}
                </code>
            ))}
            <span className="code-keys">{t("code.keys")}</span>
        </p>
    );
}

function Fault({ problem, code }: { problem: Problem; code: CodeEditor | null }) {
    const { line, column, message } = problem;
    return (
        <div className="code-fault" role="status">
            <CircleAlert size={14} aria-hidden="true" />
            {line !== undefined && (
                <button
                    type="button"
                    className="link-button"
                    onClick={() => code?.goTo(line, column ?? 1)}
                >
                    {t("code.place", { line, column: column ?? 1 })}
                </button>
            )}
            <span>{message}</span>
        </div>
    );
}

/* Why the server will not take a text, or null. */
function whyNot({ stores }: Editor, place: string, text: string): Problem | null {
    const { schema, document } = stores.document.getState();
    const found = document && paramAt(schema, document, place);
    const message = found && checkText(schema, found.param, text);
    return message ? { code: "limit", place, message } : null;
}

/* The editor, its text kept equal to the document's; `waiting`: something was not sent yet. A text
 * that is not taken stays until it is mended, with the reason in `refused`. */
function useCode(place: string, text: string) {
    const editor = useEditor();
    const { link } = editor;
    const element = useRef<HTMLDivElement>(null);
    const [code, setCode] = useState<CodeEditor | null>(null);
    const [waiting, setWaiting] = useState(false);
    const [refused, setRefused] = useState<Problem | null>(null);
    const reason = useRef<Problem | null>(null);
    const { sent, refusal } = useRefusal(place, text);
    const latest = useRef(text);
    latest.current = text;
    useEffect(() => {
        const parent = element.current;
        if (parent === null) {
            return;
        }
        const kept = keptOf(editor, place);
        const refuse = (problem: Problem | null): void => {
            reason.current = problem;
            setRefused(problem);
        };
        let gone = false;
        let mounted: CodeEditor | null = null;
        let stop: () => void = () => undefined;
        import("./mount.ts").then(({ mountCode }) => {
            if (gone) {
                return;
            }
            const send = (value: string, gesture: Gesture): void => {
                const problem = whyNot(editor, place, value);
                refuse(problem);
                if (problem === null && gesture.edit([{ op: "set", at: place, value }])) {
                    sent.current = value;
                }
            };
            const sender = sendSlowly(
                () => mounted?.text() ?? latest.current,
                send,
                () => link.gesture(t("edit.code")),
                setWaiting,
            );
            stop = sender.stop;
            const old = kept.take();
            refuse(old?.problem ?? null);
            mounted = mountCode(parent, {
                text: old?.text ?? latest.current,
                label: t("code.label"),
                onChange: sender.changed,
                onSend: sender.now,
                onLeave: sender.now,
            });
            setCode(mounted);
        });
        return () => {
            gone = true;
            stop();
            if (mounted !== null && (reason.current !== null || sent.current !== null)) {
                kept.put({ text: mounted.text(), problem: reason.current });
            }
            mounted?.destroy();
        };
    }, [editor, link, place, sent]);
    useEffect(() => {
        if (refusal !== null) {
            sent.current = null;
            reason.current = refusal.problem;
            setRefused(refusal.problem);
        } else if (code !== null && !waiting && refused === null && code.text() !== text) {
            code.setText(text);
        }
    }, [code, waiting, refused, refusal, sent, text]);
    return { element, code, waiting, refused };
}

/* Sends a text after a pause, or when told to; what follows soon is the same undo step. */
function sendSlowly(
    read: () => string,
    send: (text: string, gesture: Gesture) => void,
    begin: () => Gesture,
    onWaiting: (waiting: boolean) => void,
) {
    let timer: ReturnType<typeof setTimeout> | undefined;
    let ending: ReturnType<typeof setTimeout> | undefined;
    let gesture: Gesture | null = null;
    const end = (): void => {
        clearTimeout(ending);
        gesture?.end();
        gesture = null;
    };
    const now = (): void => {
        if (timer === undefined) {
            return;
        }
        clearTimeout(timer);
        timer = undefined;
        gesture ??= begin();
        send(read(), gesture);
        clearTimeout(ending);
        ending = setTimeout(end, STEP_MS);
        onWaiting(false);
    };
    return {
        changed: (): void => {
            clearTimeout(timer);
            clearTimeout(ending);
            timer = setTimeout(now, SEND_MS);
            onWaiting(true);
        },
        now: (): void => {
            now();
            end();
        },
        stop: (): void => {
            now();
            end();
        },
    };
}
