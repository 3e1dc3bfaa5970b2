/* SPDX-License-Identifier: MIT */
/* What goes wrong in a live scene, as the stores hold it: notices, and problems at their places. */
import type { Problem } from "../model/operation.ts";
import { addProblem, COMPILE, COMPILED, endProblem } from "../model/problems.ts";
import type { PendingEdit } from "../model/session.ts";
import { addNotice, type Stores } from "../model/stores.ts";
import { text } from "../model/texts.ts";
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

    /* Broken code is marked where it stands, again and again while somebody types. */
    fromServer({ type: _type, ...notice }: NoticeMessage): void {
        const { level, code, message, place = "" } = notice;
        if (code === COMPILED) {
            this.#stores.document.setState(({ problems }) => ({
                problems: endProblem(problems, place),
            }));
            return;
        }
        if (level === "error") {
            this.#mark({ ...notice, place });
        }
        if (code !== COMPILE || place === "") {
            this.add(level, code, message, place);
        }
    }

    #mark(problem: Problem): void {
        if (problem.place !== "") {
            this.#stores.document.setState(({ problems }) => ({
                problems: addProblem(problems, problem),
            }));
        }
    }
}
