/* SPDX-License-Identifier: MIT */
/* What goes wrong in a live scene, as the stores hold it: notices, and problems at their places. */
import type { SceneDocument } from "../model/document.ts";
import { lostTo } from "../model/lost.ts";
import type { Operation, Problem } from "../model/operation.ts";
import {
    addProblem,
    COMPILE,
    endProblem,
    endProblems,
    isEnd,
    isGivenUp,
    isStanding,
    isThere,
    isTooSlow,
} from "../model/problems.ts";
import type { PendingEdit } from "../model/session.ts";
import { addNotice, endNotices, type NoticeAct, type Stores } from "../model/stores.ts";
import { capitalised, text } from "../model/texts.ts";
import type { NoticeMessage } from "./protocol.ts";

export class Notices {
    readonly #stores: Stores;

    constructor(stores: Stores) {
        this.#stores = stores;
    }

    add(level: "info" | "warning" | "error", code: string, message: string, place = ""): void {
        addNotice(this.#stores.notices, { level, code, message, place });
    }

    /* The server did not take an edit. */
    rejected(pending: PendingEdit | null, problem: Problem): void {
        const label = pending?.label || text("edit.unnamed");
        const message = text("edit.rejected", { label, message: problem.message });
        this.add("error", problem.code, message, problem.place);
        this.#mark(problem);
    }

    /* An undo or redo left out what somebody else has changed since. */
    skipped(ops: readonly Operation[]): void {
        const [first] = ops;
        const count = ops.length;
        const message = text(count === 1 ? "undo.skippedOne" : "undo.skipped", { count });
        addNotice(this.#stores.notices, {
            level: "warning",
            code: "overwritten",
            message,
            place: first && "at" in first ? first.at : "",
            acts: [{ kind: "edit", ops, label: text("undo.anywayLabel") }],
        });
    }

    /* Somebody else took away what is looked at, or gave it another name. */
    lost(before: SceneDocument, after: SceneDocument): void {
        const { gone, view } = lostTo(before, after, this.#stores.view.getState());
        this.#stores.view.setState(view);
        if (gone !== null) {
            const message = text("edit.deletedByOther", { name: capitalised(gone) });
            this.add("warning", "lost", message);
        }
    }

    /* Broken code is marked where it stands, again and again while somebody types. */
    fromServer({ type: _type, ...notice }: NoticeMessage): void {
        const { level, code, message, place = "" } = notice;
        if (isEnd(code)) {
            this.#end(place);
            return;
        }
        if (level === "error") {
            this.#mark({ ...notice, place });
        }
        if (isGivenUp(code)) {
            const acts = this.#actsFor(place, isTooSlow(notice));
            addNotice(this.#stores.notices, { level, code, message, place, acts });
        } else if (code !== COMPILE || place === "") {
            this.add(level, code, message, place);
        } else {
            this.#endNotice(place); /* what is wrong there now is said at the place */
        }
    }

    /* The server tells again what still stands. */
    welcome(): void {
        const { document, notices } = this.#stores;
        document.setState(({ problems }) => ({ problems: endProblems(problems) }));
        endNotices(notices, isStanding);
    }

    /* Nothing is wrong at a place that is gone. */
    dropGone(): void {
        const { document } = this.#stores.document.getState();
        endNotices(
            this.#stores.notices,
            ({ code, place }) =>
                isStanding({ code }) && document !== null && !isThere(document, place),
        );
    }

    #end(place: string): void {
        this.#stores.document.setState(({ problems }) => ({
            problems: endProblem(problems, place),
        }));
        this.#endNotice(place);
    }

    #endNotice(place: string): void {
        endNotices(this.#stores.notices, (one) => isStanding(one) && one.place === place);
    }

    #actsFor(place: string, slow: boolean): readonly NoticeAct[] {
        const step = this.#stores.document.getState().history.undo.at(-1);
        const retry: NoticeAct = { kind: "retry", place, slow };
        return step ? [retry, { kind: "undo", label: step.label }] : [retry];
    }

    #mark(problem: Problem): void {
        if (problem.place !== "") {
            this.#stores.document.setState(({ problems }) => ({
                problems: addProblem(problems, problem),
            }));
        }
    }
}
