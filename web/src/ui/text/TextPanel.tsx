/* SPDX-License-Identifier: MIT */
/* The whole scene as text: a view of the one tree where everything can be typed. */
import { CircleAlert, CircleCheck, Users, X } from "lucide-react";
import { useEffect, useRef, useState } from "react";
import { subjectAt } from "../../model/documentText.ts";
import { nodeOfPlace, type RecordName, resourceOfPlace } from "../../model/places.ts";
import { toggleDrawer } from "../../model/view.ts";
import type { Editor } from "../editor.ts";
import { selectNode } from "../insertions.ts";
import { useDocument, useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { Button, IconButton } from "../widgets/Button.tsx";
import { useLeftFocus } from "../widgets/leftFocus.ts";
import { Tip } from "../widgets/Tip.tsx";
import { CALM, type DraftState, TextDraft } from "./draft.ts";
import type { Fault, TextEditor } from "./mount.ts";
import "../code/code.css";
import "./text.css";

/* Faults that are listed below the text. */
const MOST_LISTED = 6;

interface Open {
    readonly text: TextEditor;
    readonly draft: TextDraft;
}

export default function TextPanel() {
    const { stores } = useEditor();
    const { element, open, state } = useDraft();
    const below = state.faults.length;
    // biome-ignore lint/correctness/useExhaustiveDependencies: what stands below takes room
    useEffect(() => open?.text.keepCursor(), [open, below, state.others, state.meeting]);
    return (
        <section
            ref={useLeftFocus()}
            className="code-panel text-panel"
            aria-label={t("text.title")}
            data-testid="text"
            data-typed={state.typed || undefined}
            data-waiting={state.waiting || undefined}
            data-region={t("text.title")}
            tabIndex={-1}
            onKeyDown={(event) => {
                /* Escape lets Tab leave the editor; it closes nothing here. */
                if (event.key === "Escape") {
                    event.stopPropagation();
                }
            }}
        >
            <header className="code-head">
                <h2 className="code-title">{t("text.title")}</h2>
                <State state={state} onShow={open?.text ?? null} />
                <span className="text-hint ellipsis">{t("text.hint")}</span>
                <IconButton
                    title={t("close")}
                    data-size="s"
                    onClick={() => stores.view.setState(toggleDrawer("text"))}
                >
                    <X size={15} />
                </IconButton>
            </header>
            {open && <Others state={state} draft={open.draft} />}
            <div ref={element} className="code-text" data-loading={open === null || undefined} />
            {open && <Faults faults={state.faults} text={open.text} />}
        </section>
    );
}

function State({ state, onShow }: { state: DraftState; onShow: TextEditor | null }) {
    const { waiting, typed, faults, meeting } = state;
    const [first] = faults;
    if (waiting) {
        return <span className="code-state">{t("text.typing")}</span>;
    }
    if (meeting) {
        return (
            <span className="code-state" data-bad="">
                <Users size={14} aria-hidden="true" />
                {t("text.met")}
            </span>
        );
    }
    if (first === undefined) {
        return (
            <span className="code-state" data-good="">
                <CircleCheck size={14} aria-hidden="true" />
                {t("text.same")}
            </span>
        );
    }
    return (
        <button
            type="button"
            className="code-state"
            data-bad=""
            onClick={() => onShow?.goTo(first.from)}
        >
            <CircleAlert size={14} aria-hidden="true" />
            {t(typed ? "text.faults" : "text.broken", { count: faults.length })}
        </button>
    );
}

/* Somebody else has changed the scene while this text was typed. */
function Others({ state, draft }: { state: DraftState; draft: TextDraft }) {
    const { meeting } = state;
    if (!state.typed || !(state.others || meeting)) {
        return null;
    }
    const message =
        meeting === null
            ? t("text.others")
            : meeting.places.length > 0
              ? t("text.meeting", { places: meeting.places.join(", ") })
              : t("text.gone", { message: meeting.message });
    return (
        <div className="text-others" role="status" data-testid="text-others">
            <Users size={14} aria-hidden="true" />
            <p>{message}</p>
            <div className="text-choices">
                {meeting && (
                    <Button look="primary" onClick={() => draft.keepMine()}>
                        {t("text.mine")}
                    </Button>
                )}
                <Tip text={t("text.dropTip")}>
                    <Button look="outline" onClick={() => draft.showScene()}>
                        {t(meeting ? "text.theirs" : "text.drop")}
                    </Button>
                </Tip>
            </div>
        </div>
    );
}

function Faults({ faults, text }: { faults: readonly Fault[]; text: TextEditor }) {
    if (faults.length === 0) {
        return null;
    }
    const more = faults.length - MOST_LISTED;
    return (
        <ul className="text-faults" role="status">
            {faults.slice(0, MOST_LISTED).map((fault) => (
                <li key={`${fault.from} ${fault.message}`}>
                    <button
                        type="button"
                        className="link-button"
                        onClick={() => text.goTo(fault.from)}
                    >
                        {t("code.place", text.lineOf(fault.from))}
                    </button>
                    <span>{fault.message}</span>
                </li>
            ))}
            {more > 0 && <li>{t("text.moreFaults", { count: more })}</li>}
        </ul>
    );
}

/* The editor and what keeps it equal to the scene. */
function useDraft() {
    const editor = useEditor();
    const element = useRef<HTMLDivElement>(null);
    const [open, setOpen] = useState<Open | null>(null);
    const [state, setState] = useState(CALM);
    const scene = useDocument((now) => (now.document === null ? null : now.scene));
    useEffect(() => {
        const parent = element.current;
        const { document } = editor.stores.document.getState();
        if (parent === null || document === null || scene === null) {
            return;
        }
        let gone = false;
        let end: () => void = () => undefined;
        import("./mount.ts").then(({ mountText }) => {
            const now = editor.stores.document.getState().document;
            if (gone || now === null) {
                return;
            }
            const text = mountText(parent, "", t("text.label"), {
                onType: () => draft.typed(),
                onApply: () => draft.apply(true),
                onLeave: () => draft.left(),
                onCursor: (offset) => showAt(editor, draft, offset),
            });
            const draft = new TextDraft(editor, now, text, setState);
            end = () => {
                draft.end();
                text.destroy();
            };
            setOpen({ text, draft });
        });
        return () => {
            gone = true;
            end();
            setOpen(null);
            setState(CALM);
        };
    }, [editor, scene]);
    return { element, open, state };
}

/* Selects what the cursor stands in. */
function showAt(editor: Editor, draft: TextDraft, offset: number): void {
    const { document } = editor.stores.document.getState();
    const place = document && subjectAt(document, draft.parts, offset);
    if (!place) {
        return;
    }
    const node = nodeOfPlace(place);
    const resource = resourceOfPlace(place);
    const { selection, subject } = editor.stores.view.getState();
    if (node !== null) {
        if (subject.kind !== "nodes" || selection.length !== 1 || selection[0] !== node) {
            selectNode(editor, node);
        }
    } else if (resource !== null) {
        editor.show({ kind: "resource", ...resource });
    } else {
        editor.show({ kind: place.slice(1) as RecordName });
    }
}
