/* SPDX-License-Identifier: MIT */
/* Keeps a text and the scene equal: the text follows the scene until somebody types in it; what is
 * typed becomes edits after a pause. No React. */
import type { SceneDocument } from "../../model/document.ts";
import { faultAt, type TextFault } from "../../model/documentRead.ts";
import { documentText, type Part, partsOf } from "../../model/documentText.ts";
import { parseText } from "../../model/jsonText.ts";
import type { Operation } from "../../model/operation.ts";
import { nodeOfPlace, resourceOfPlace } from "../../model/places.ts";
import { isStanding } from "../../model/problems.ts";
import {
    type Judged,
    judgeText,
    type Meeting,
    ownerOf,
    type TooMuch,
} from "../../model/textDraft.ts";
import type { Editor } from "../editor.ts";
import { t } from "../texts.ts";
import type { TextEditor } from "./mount.ts";

/* A pause in typing after which the text is applied. */
const PAUSE_MS = 600;
/* Following takes a part of the time at most: one in as many. */
const SHARE = 8;

export interface DraftState {
    /* Something is typed that the scene does not say. */
    readonly typed: boolean;
    readonly waiting: boolean;
    readonly faults: readonly TextFault[];
    /* The scene has changed since somebody began to type. */
    readonly others: boolean;
    readonly meeting: Meeting | null;
}

export const CALM: DraftState = {
    typed: false,
    waiting: false,
    faults: [],
    others: false,
    meeting: null,
};

/* What was typed and is not valid yet stays while the panel is closed. */
interface Kept {
    readonly scene: string;
    readonly text: string;
    readonly base: SceneDocument;
}
const kept = new WeakMap<Editor, Kept>();

const tellTooMuch: TooMuch = (limit, count, most) =>
    limit === "operations"
        ? t("text.many", { count, most })
        : t("text.large", { bytes: count, most });

export class TextDraft {
    readonly #editor: Editor;
    readonly #text: TextEditor;
    readonly #onState: (state: DraftState) => void;
    readonly #scene: string;
    readonly #stops: (() => void)[] = [];
    #state = CALM;
    /* The scene that the text was when nobody had typed, and its canonical text. */
    #base: SceneDocument;
    #printed: string;
    /* The scene looked at last. */
    #seen: SceneDocument;
    /* Of the newest text that could be read. */
    #parts: readonly Part[] | null = null;
    /* Sent and not settled yet, and the text that it came from. */
    #sent: { readonly ops: readonly Operation[]; readonly text: string } | null = null;
    #pause: ReturnType<typeof setTimeout> | undefined;
    #follow: ReturnType<typeof setTimeout> | undefined;
    #cost = 0;

    constructor(
        editor: Editor,
        document: SceneDocument,
        text: TextEditor,
        onState: (state: DraftState) => void,
    ) {
        this.#editor = editor;
        this.#scene = editor.stores.document.getState().scene ?? "";
        this.#text = text;
        this.#onState = onState;
        this.#base = document;
        this.#seen = document;
        this.#printed = this.#print(document);
        text.setText(this.#printed);
        this.#restore();
        const { document: documents, view } = editor.stores;
        this.#stops.push(
            documents.subscribe((now, before) => {
                if (now.document !== before.document || now.problems !== before.problems) {
                    this.#changed();
                }
            }),
            view.subscribe((now, before) => {
                if (now.selection !== before.selection || now.subject !== before.subject) {
                    this.mark(!this.#text.hasFocus());
                }
            }),
        );
        this.mark(true);
        this.#showProblems();
    }

    /* --- what the hand does --- */

    typed(): void {
        this.#parts = null;
        clearTimeout(this.#pause);
        this.#pause = setTimeout(() => this.apply(false), PAUSE_MS);
        this.#tell({ ...this.#state, typed: true, waiting: true, meeting: null });
    }

    /* `tidy`: the text is printed anew, as the server would. */
    apply(tidy: boolean): void {
        clearTimeout(this.#pause);
        const now = this.#now();
        if (!this.#state.typed || now === null) {
            if (tidy) {
                this.#reprint();
            }
            return;
        }
        const { schema } = this.#editor.stores.document.getState();
        this.#take(judgeText(schema, this.#base, now, this.#text.text(), tellTooMuch), tidy);
    }

    left(): void {
        if (this.#state.waiting) {
            this.apply(false);
        }
        if (!this.#state.typed) {
            this.#reprint();
        }
    }

    /* Of two that have changed the same. */
    keepMine(): void {
        const ops = this.#state.meeting?.ops ?? [];
        if (ops.length === 0 || this.#send(ops)) {
            this.#settle(true);
        }
    }

    showScene(): void {
        clearTimeout(this.#pause);
        this.#sent = null;
        this.#settle(true, true);
        this.#text.focus();
    }

    end(): void {
        if (this.#state.waiting) {
            this.apply(false);
        }
        clearTimeout(this.#pause);
        clearTimeout(this.#follow);
        for (const stop of this.#stops) {
            stop();
        }
        if (this.#state.typed) {
            const text = this.#text.text();
            kept.set(this.#editor, { scene: this.#scene, text, base: this.#base });
        }
    }

    /* --- what becomes of the text --- */

    #take(judged: Judged, tidy: boolean): void {
        const state = { ...this.#state, waiting: false };
        if (judged.kind === "faults") {
            this.#show(judged.faults);
            this.#tell({ ...state, faults: judged.faults });
            return;
        }
        if (judged.kind === "meeting") {
            this.#show([]);
            this.#tell({ ...state, faults: [], meeting: judged.meeting });
            return;
        }
        const now = this.#now();
        const others = now !== null && this.#print(now) !== this.#printed;
        if (judged.ops.length === 0 || this.#send(judged.ops)) {
            this.#parts = judged.parts;
            this.#settle(tidy || others);
        }
    }

    #send(ops: readonly Operation[]): boolean {
        const owner = ownerOf(this.#base, ops);
        const label = owner === null ? t("text.edit") : t("text.editOne", { name: owner });
        const text = this.#text.text();
        const done = this.#editor.link.edit(ops, { label });
        this.#sent = done ? { ops, text } : this.#sent;
        return done;
    }

    /* The text and the scene say the same. */
    #settle(tidy: boolean, undoable = false): void {
        const now = this.#now();
        if (now === null) {
            return;
        }
        this.#base = now;
        this.#seen = now;
        this.#printed = this.#print(now);
        if (tidy) {
            this.#reprint(undoable);
        }
        this.#tell(CALM);
        this.#showProblems();
        this.mark(false);
    }

    #reprint(undoable = false): void {
        if (this.#text.text() !== this.#printed) {
            this.#text.setText(this.#printed, undoable);
            this.#parts = null;
            this.mark(false);
        }
    }

    /* --- what the scene does --- */

    #changed(): void {
        const now = this.#now();
        if (now === null) {
            return;
        }
        if (this.#refused(now)) {
            return;
        }
        if (now === this.#seen) {
            this.#showProblems();
        } else if (this.#state.typed) {
            this.#seen = now;
            this.#noticeOthers(now);
        } else {
            this.#followSoon();
        }
    }

    /* The server did not take what was typed: it stays as it is, with the fault at its place. */
    #refused(now: SceneDocument): boolean {
        const { problems, saved } = this.#editor.stores.document.getState();
        const sent = this.#sent;
        if (sent === null) {
            return false;
        }
        const owners = sent.ops.map((op) => ownOf("at" in op ? op.at : op.into));
        const problem = [...problems.values()].find(
            (one) => !isStanding(one) && owners.includes(ownOf(one.place)),
        );
        if (problem === undefined || this.#print(now) === this.#printed) {
            this.#sent = saved ? null : sent;
            return false;
        }
        this.#sent = null;
        if (this.#text.text() === this.#printed) {
            this.#text.setText(sent.text);
        }
        this.#base = now;
        this.#seen = now;
        this.#parts = null;
        const fault = faultAt(this.#partsNow(), problem);
        this.#show([fault]);
        this.#tell({ ...CALM, typed: true, faults: [fault] });
        return true;
    }

    #noticeOthers(now: SceneDocument): void {
        if (!this.#state.others && this.#print(now) !== this.#printed) {
            this.#tell({ ...this.#state, others: true });
        }
    }

    /* Printing a large scene takes a while; a drag changes it for each picture. */
    #followSoon(): void {
        this.#follow ??= setTimeout(() => {
            this.#follow = undefined;
            const now = this.#now();
            if (now !== null && !this.#state.typed) {
                this.#followNow(now);
            }
        }, this.#cost * SHARE);
    }

    #followNow(now: SceneDocument): void {
        const begun = performance.now();
        const printed = this.#print(now);
        this.#base = now;
        this.#seen = now;
        if (printed !== this.#printed) {
            this.#printed = printed;
            this.#text.setText(printed);
            this.#parts = null;
            this.mark(false);
        }
        this.#showProblems();
        this.#cost = performance.now() - begun;
    }

    #restore(): void {
        const old = kept.get(this.#editor);
        kept.delete(this.#editor);
        if (old?.scene === this.#scene) {
            this.#text.setText(old.text);
            const others = this.#print(old.base) !== this.#printed;
            this.#base = old.base;
            this.#printed = this.#print(old.base);
            this.#tell({ ...CALM, typed: true, others });
            this.apply(false);
        }
    }

    /* --- what is shown --- */

    /* Marks the lines of what is selected; `shown`: they come in sight. */
    mark(shown: boolean): void {
        const { selection, subject } = this.#editor.stores.view.getState();
        const places =
            subject.kind === "nodes"
                ? selection.map((id) => `/nodes/${id}`)
                : subject.kind === "resource"
                  ? [`/${subject.list}/${subject.name}`]
                  : [`/${subject.kind}`];
        const all = places.length > 0 ? this.#partsNow() : [];
        const found = all.filter(({ place }) => places.includes(place));
        const spans = found.map(({ from, to, key }) => ({ from: key?.from ?? from, to }));
        const last = found.findIndex(({ place }) => place === places.at(-1));
        if (all.length > 0 || places.length === 0) {
            this.#text.mark(spans, shown ? (spans[last] ?? null) : null);
        }
    }

    /* Of the text as it stands; none while it cannot be read. */
    #partsNow(): readonly Part[] {
        if (this.#parts === null) {
            const parsed = parseText(this.#text.text());
            this.#parts = parsed.ok ? partsOf(parsed.value) : [];
        }
        return this.#parts;
    }

    get parts(): readonly Part[] {
        return this.#partsNow();
    }

    /* Code that does not compile, where it stands. */
    #showProblems(): void {
        if (this.#state.typed) {
            return;
        }
        const { problems } = this.#editor.stores.document.getState();
        const standing = [...problems.values()].filter(
            (one) => one.place !== "" && isStanding(one),
        );
        const parts = standing.length > 0 ? this.#partsNow() : [];
        const faults = standing.map((one) => {
            const message =
                one.line === undefined
                    ? one.message
                    : t("code.at", { line: one.line, message: one.message });
            return faultAt(parts, { ...one, message });
        });
        if (faults.length > 0 || this.#state.faults.length > 0) {
            this.#show(faults);
            this.#tell({ ...this.#state, faults });
        }
    }

    #show(faults: readonly TextFault[]): void {
        this.#text.setFaults(faults);
    }

    #tell(state: DraftState): void {
        if (state === CALM && this.#state.faults.length > 0) {
            this.#show([]);
        }
        this.#state = state;
        this.#onState(state);
    }

    #now(): SceneDocument | null {
        return this.#editor.stores.document.getState().document;
    }

    #print(document: SceneDocument): string {
        return documentText(this.#editor.stores.document.getState().schema, document);
    }
}

/* The node or resource that a place lies in, else the place. */
function ownOf(place: string): string {
    const resource = resourceOfPlace(place);
    return nodeOfPlace(place) ?? (resource ? `/${resource.list}/${resource.name}` : place);
}
