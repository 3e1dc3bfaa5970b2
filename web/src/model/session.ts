/* SPDX-License-Identifier: MIT */
/* One editor's side of a live scene: what the server has confirmed, what is still on its way, and
 * the document to show, which is the one with the other on top. Pure functions on an immutable
 * state; sending, time and sockets are the link's. */

import type { SceneDocument } from "./document.ts";
import { readDocument } from "./documentJson.ts";
import type { Json } from "./json.ts";
import type { Operation, Problem } from "./operation.ts";
import { apply, join } from "./operations.ts";
import type { Schema } from "./schema.ts";

export type Epoch = string | number;

/* Something of ours that the server has not settled yet. */
export interface PendingEdit {
    readonly edit: number;
    readonly kind: "edit" | "undo" | "redo";
    readonly ops: readonly Operation[];
    /* Of an undo: the group that it takes back, where it is for one. */
    readonly group: string;
    readonly label: string;
    readonly sent: boolean;
}

export interface Session {
    readonly schema: Schema;
    readonly confirmed: SceneDocument | null;
    readonly shown: SceneDocument | null;
    readonly revision: number;
    readonly epoch: Epoch | null;
    /* False from a resync to the next document: then `confirmed` is no state of the server's. */
    readonly fits: boolean;
    /* Not yet part of `confirmed`, in the order made. */
    readonly pending: readonly PendingEdit[];
    /* Part of `confirmed`, not yet told durable: sent again if the server comes back without. */
    readonly settling: readonly PendingEdit[];
    readonly nextEdit: number;
    /* Group of the newest edit that was sent. */
    readonly sentGroup: string;
    /* Group of the newest edit that the server has applied. */
    readonly appliedGroup: string;
    /* Steps that the server can undo and redo for us. */
    readonly undo: number;
    readonly redo: number;
    readonly online: boolean;
    /* After a reconnect: our edits up to `landedEdit` are in the log and will have arrived when
     * `revision` reaches `landedRevision`. */
    readonly landedEdit: number;
    readonly landedRevision: number;
}

/* The messages that a session understands; protocol.ts has all of them. */
export type SessionMessage =
    | {
          readonly type: "welcome";
          readonly revision: number;
          readonly epoch: Epoch;
          readonly last_edit: number;
          readonly undo?: number;
          readonly redo?: number;
          /* What the newest steps are called, newest first. */
          readonly undo_labels?: readonly string[];
          readonly redo_labels?: readonly string[];
      }
    | { readonly type: "document"; readonly revision: number; readonly document: Json }
    | {
          readonly type: "applied";
          readonly edit: number;
          readonly revision: number;
          readonly durable: boolean;
          readonly undo: number;
          readonly redo: number;
          /* Of an undo or redo: what it left out, since somebody else has changed it. */
          readonly skipped?: readonly Operation[];
      }
    | {
          readonly type: "changed";
          readonly revision: number;
          readonly author: string;
          readonly ops: readonly Operation[];
          readonly edit?: number;
      }
    | {
          readonly type: "rejected";
          readonly edit: number;
          readonly code: string;
          readonly place: string;
          readonly message: string;
          readonly line?: number;
          readonly column?: number;
          readonly skipped?: readonly Operation[];
      };

/* What else a message meant. `resync`: the state does not fit the server's; ask for the document
 * by connecting anew without a revision. */
export type SessionEvent =
    /* `cancelled`: the user has given it up already. */
    | {
          readonly kind: "rejected";
          readonly pending: PendingEdit | null;
          readonly problem: Problem;
          readonly cancelled: boolean;
      }
    | { readonly kind: "skipped"; readonly ops: readonly Operation[] }
    /* `ops`: what an undo or redo did. */
    | {
          readonly kind: "done";
          readonly pending: PendingEdit;
          readonly ops?: readonly Operation[];
      }
    | { readonly kind: "changed"; readonly author: string; readonly ops: readonly Operation[] }
    | { readonly kind: "reset" }
    | { readonly kind: "resync" };

export interface Outcome {
    readonly session: Session;
    readonly events: readonly SessionEvent[];
}

/* Names the same edit that goes over the wire; protocol.ts adds nothing. */
export type OutgoingEdit =
    | {
          readonly type: "edit";
          readonly edit: number;
          readonly ops: readonly Operation[];
          readonly group?: string;
          readonly label?: string;
      }
    | { readonly type: "undo"; readonly edit: number }
    | { readonly type: "redo"; readonly edit: number };

export function createSession(schema: Schema): Session {
    return {
        schema,
        confirmed: null,
        shown: null,
        revision: 0,
        epoch: null,
        fits: true,
        pending: [],
        settling: [],
        nextEdit: 1,
        sentGroup: "",
        appliedGroup: "",
        undo: 0,
        redo: 0,
        online: false,
        landedEdit: 0,
        landedRevision: 0,
    };
}

/* Puts the pending edits on top of `confirmed` again. One that no longer fits is left out here;
 * the server will refuse it and say why. */
function rebase(session: Session): Session {
    let shown = session.confirmed;
    for (const pending of session.pending) {
        const result = shown && apply(shown, pending.ops, session.schema);
        shown = result?.ok ? result.document : shown;
    }
    return { ...session, shown };
}

/* --- ours --- */

/* Shows an edit at once and queues it. Edits of one group that were not sent yet become one. */
export function edit(
    session: Session,
    ops: readonly Operation[],
    options: { readonly group?: string; readonly label?: string } = {},
): { readonly session: Session; readonly problem: Problem | null } {
    if (session.shown === null) {
        const problem = { code: "unavailable", place: "", message: "the scene is not loaded yet" };
        return { session, problem };
    }
    const result = apply(session.shown, ops, session.schema);
    if (!result.ok) {
        return { session, problem: result.problem };
    }
    const group = options.group ?? "";
    const label = options.label ?? "";
    const last = session.pending.at(-1);
    const shown = { ...session, shown: result.document };
    if (last && !last.sent && last.kind === "edit" && group !== "" && last.group === group) {
        const joined = {
            ...last,
            ops: join(session.schema, last.ops, ops),
            label: label || last.label,
        };
        const pending = [...session.pending.slice(0, -1), joined];
        return { session: { ...shown, pending }, problem: null };
    }
    return { session: queue(shown, { kind: "edit", ops, group, label }), problem: null };
}

function queue(
    session: Session,
    entry: Pick<PendingEdit, "kind" | "ops" | "group" | "label">,
): Session {
    const pending = { ...entry, edit: session.nextEdit, sent: false };
    return {
        ...session,
        pending: [...session.pending, pending],
        nextEdit: session.nextEdit + 1,
    };
}

/* Asks for an undo or redo. What it changes is the server's to say. */
export function askHistory(session: Session, kind: "undo" | "redo"): Session {
    return queue(session, { kind, ops: [], group: "", label: "" });
}

function outgoing(pending: PendingEdit): OutgoingEdit {
    if (pending.kind !== "edit") {
        return { type: pending.kind, edit: pending.edit };
    }
    return {
        type: "edit",
        edit: pending.edit,
        ops: pending.ops,
        ...(pending.group ? { group: pending.group } : {}),
        ...(pending.label ? { label: pending.label } : {}),
    };
}

/* An undo of a group waits for what of the group is not settled: all of it may be refused, and an
 * older step would be the newest. */
function waits({ pending }: Session, { kind, group }: PendingEdit): boolean {
    return kind === "undo" && group !== "" && pending.some((entry) => isOfGroup(entry, group));
}

/* Does something of ours wait, with all that is behind it, for an answer of the server? */
export function isHeldBack(session: Session): boolean {
    return session.pending.some((entry) => waits(session, entry));
}

/* Takes what is to be sent now; nothing while offline. */
export function takeOutbox(session: Session): {
    readonly session: Session;
    readonly messages: readonly OutgoingEdit[];
} {
    const first = session.pending.findIndex((entry) => waits(session, entry));
    const ready = first < 0 ? session.pending : session.pending.slice(0, first);
    const unsent = ready.filter((pending) => !pending.sent);
    const last = unsent.at(-1);
    if (!session.online || !last) {
        return { session, messages: [] };
    }
    const pending = session.pending.map((entry) =>
        unsent.includes(entry) ? { ...entry, sent: true } : entry,
    );
    const sentGroup = last.kind === "edit" ? last.group : "";
    return { session: { ...session, pending, sentGroup }, messages: unsent.map(outgoing) };
}

function isOfGroup(entry: PendingEdit, group: string): boolean {
    return entry.kind === "edit" && entry.group === group;
}

/* Is the group the server's newest step? Not where all of it that was sent was refused. */
export function isStep(session: Session, group: string): boolean {
    const { sentGroup, appliedGroup, pending } = session;
    const sent = pending.some((entry) => entry.sent && isOfGroup(entry, group));
    return sentGroup === group && (sent || appliedGroup === group);
}

/* Takes back the edits of a group: those not sent are forgotten, others the server undoes. */
export function cancelGroup(session: Session, group: string): Session {
    const pending = session.pending.filter((entry) => entry.sent || !isOfGroup(entry, group));
    const dropped = rebase({ ...session, pending });
    return isStep(session, group)
        ? queue(dropped, { kind: "undo", ops: [], group, label: "" })
        : dropped;
}

/* Without undos of groups of which nothing was applied. */
function dropIdle(session: Session): Session {
    const isIdle = (entry: PendingEdit): boolean =>
        entry.kind === "undo" &&
        !["", session.appliedGroup].includes(entry.group) &&
        !waits(session, entry);
    return { ...session, pending: session.pending.filter((entry) => entry.sent || !isIdle(entry)) };
}

/* The connection is gone: nothing is lost, what was sent may have to be sent again. */
export function disconnect(session: Session): Session {
    return { ...session, online: false };
}

/* Edits that the user has made and the server does not hold yet. */
export function waiting(session: Session): number {
    return session.pending.length;
}

export function isSaved(session: Session): boolean {
    return session.pending.length === 0 && session.settling.length === 0;
}

/* Whether there will be a step to undo and one to redo when all that waits is done. */
export function stepsAhead(session: Session): {
    readonly canUndo: boolean;
    readonly canRedo: boolean;
} {
    let { undo, redo } = session;
    for (const { kind } of session.pending) {
        if (kind === "edit") {
            undo += 1;
            redo = 0;
        } else {
            ({ undo, redo } = moveSteps({ undo, redo }, kind));
        }
    }
    return { canUndo: undo > 0, canRedo: redo > 0 };
}

interface Steps {
    readonly undo: number;
    readonly redo: number;
}

/* One step goes from one list to the other, if there is one. */
function moveSteps({ undo, redo }: Steps, kind: "undo" | "redo"): Steps {
    const moved = Math.min(1, kind === "undo" ? undo : redo);
    const step = kind === "undo" ? -moved : moved;
    return { undo: undo + step, redo: redo - step };
}

/* --- the server's --- */

function welcome(session: Session, message: Extract<SessionMessage, { type: "welcome" }>): Outcome {
    const last = message.last_edit;
    const lost = session.settling.filter((entry) => entry.edit > last);
    /* What is not in the log is counted anew: numbers may not leave wide gaps. */
    let newest = last;
    const pending = [...lost, ...session.pending].map((entry) =>
        entry.edit <= last ? { ...entry, sent: true } : { ...entry, edit: ++newest, sent: false },
    );
    return {
        session: dropLanded({
            ...session,
            online: true,
            epoch: message.epoch,
            pending,
            settling: [],
            nextEdit: newest + 1,
            appliedGroup: lost.length > 0 ? "" : session.appliedGroup,
            undo: message.undo ?? session.undo,
            redo: message.redo ?? session.redo,
            landedEdit: last,
            landedRevision: message.revision,
        }),
        events: [],
    };
}

function dropLanded(session: Session): Session {
    if (session.confirmed === null || session.revision < session.landedRevision) {
        return session;
    }
    const landed = session.pending.filter((entry) => entry.edit <= session.landedEdit);
    return landed.reduce(land, session);
}

/* An edit of ours is part of `confirmed`. */
function land(session: Session, { edit, kind, group }: PendingEdit): Session {
    const appliedGroup = kind === "edit" ? group : session.appliedGroup;
    return { ...without(session, edit), appliedGroup };
}

function document(
    session: Session,
    message: Extract<SessionMessage, { type: "document" }>,
): Outcome {
    const next = {
        ...session,
        confirmed: readDocument(message.document),
        revision: message.revision,
        fits: true,
    };
    return { session: rebase(dropLanded(next)), events: [{ kind: "reset" }] };
}

function without(session: Session, edit: number): Session {
    return { ...session, pending: session.pending.filter((entry) => entry.edit !== edit) };
}

/* Brings `confirmed` to `revision` by `ops`; null where that does not fit. */
function advance(session: Session, revision: number, ops: readonly Operation[]): Session | null {
    if (session.confirmed === null || revision !== session.revision + 1) {
        return null;
    }
    const result = apply(session.confirmed, ops, session.schema);
    return result.ok ? { ...session, confirmed: result.document, revision } : null;
}

function resync(session: Session, events: readonly SessionEvent[] = []): Outcome {
    return { session: { ...session, fits: false }, events: [...events, { kind: "resync" }] };
}

function skipped(ops: readonly Operation[] | undefined): readonly SessionEvent[] {
    return ops && ops.length > 0 ? [{ kind: "skipped", ops }] : [];
}

function applied(session: Session, message: Extract<SessionMessage, { type: "applied" }>): Outcome {
    const told = skipped(message.skipped);
    const entry = session.pending.find((pending) => pending.edit === message.edit);
    let next: Session = { ...session, undo: message.undo, redo: message.redo };
    if (message.durable) {
        const settling = next.settling.filter((settled) => settled.edit > message.edit);
        next = { ...next, settling };
    }
    if (!entry) {
        return { session: next, events: told };
    }
    if (message.revision > session.revision) {
        if (entry.kind !== "edit") {
            const { undo, redo } = session; /* its `changed` is still to come, and counts */
            return { session: { ...next, undo, redo }, events: told };
        }
        const advanced = advance(next, message.revision, entry.ops);
        if (!advanced) {
            return resync(next);
        }
        const settling = message.durable ? [] : [{ ...entry, sent: true }];
        next = { ...advanced, settling: [...advanced.settling, ...settling] };
    }
    const settled = rebase(dropLanded(land(next, entry)));
    return { session: settled, events: [...told, { kind: "done", pending: entry }] };
}

/* Until the server tells the counts itself. */
function countHistory(session: Session, kind: PendingEdit["kind"]): Session {
    return kind === "edit" ? session : { ...session, ...moveSteps(session, kind) };
}

function changed(session: Session, message: Extract<SessionMessage, { type: "changed" }>): Outcome {
    const entry = session.pending.find((pending) => pending.edit === message.edit);
    const { ops } = message;
    const events: SessionEvent[] = entry ? [{ kind: "done", pending: entry, ops }] : [];
    let next = entry ? land(session, entry) : session;
    if (message.revision > session.revision) {
        const advanced = advance(next, message.revision, message.ops);
        if (!advanced) {
            return resync(next, events);
        }
        next = entry ? countHistory(advanced, entry.kind) : advanced;
        events.push({ kind: "changed", author: message.author, ops: message.ops });
    }
    return { session: rebase(dropLanded(next)), events };
}

/* All that a step would do was left out: it is gone. */
function stepGone(session: Session, pending: PendingEdit | null): Session {
    return pending && pending.kind !== "edit"
        ? { ...session, [pending.kind]: Math.max(0, session[pending.kind] - 1) }
        : session;
}

function rejected(
    session: Session,
    message: Extract<SessionMessage, { type: "rejected" }>,
): Outcome {
    const pending = session.pending.find((entry) => entry.edit === message.edit) ?? null;
    const { code, place, message: text, line, column } = message;
    const problem: Problem = {
        code,
        place,
        message: text,
        ...(line === undefined ? {} : { line }),
        ...(column === undefined ? {} : { column }),
    };
    const cancelled = session.pending.some(
        ({ kind, group }) => kind === "undo" && group !== "" && group === pending?.group,
    );
    let next = dropIdle(without(session, message.edit));
    if (message.skipped) {
        return { session: rebase(stepGone(next, pending)), events: skipped(message.skipped) };
    }
    if (pending && pending.kind !== "edit") {
        next = { ...next, [pending.kind]: 0 }; /* there was nothing left */
    }
    return {
        session: rebase(next),
        events: [{ kind: "rejected", pending, problem, cancelled }],
    };
}

/* Takes one message of the server. What still comes of a connection that is given up is ignored:
 * the next one tells it. */
export function receive(session: Session, message: SessionMessage): Outcome {
    if (!session.fits && (message.type === "applied" || message.type === "changed")) {
        return { session, events: [] };
    }
    switch (message.type) {
        case "welcome":
            return welcome(session, message);
        case "document":
            return document(session, message);
        case "applied":
            return applied(session, message);
        case "changed":
            return changed(session, message);
        case "rejected":
            return rejected(session, message);
    }
}
