/* SPDX-License-Identifier: MIT */
/* What an edit says, and what speaks against it. */
import type { Json, JsonObject } from "./json.ts";

export type Operation =
    | { readonly op: "set"; readonly at: string; readonly value: Json }
    | {
          readonly op: "insert";
          readonly into: string;
          readonly before: string | null;
          readonly value: JsonObject;
          readonly name?: string;
      }
    | { readonly op: "remove"; readonly at: string }
    | {
          readonly op: "move";
          readonly at: string;
          readonly into: string;
          readonly before: string | null;
      };

export interface Problem {
    readonly code: string;
    readonly place: string;
    readonly message: string;
    /* In the text at `place`, from 1. */
    readonly line?: number;
    readonly column?: number;
    /* Of a scene that is left out. */
    readonly reason?: RefusalReason;
}

/* Why something is not tried again before somebody asks for it. */
export type RefusalReason = "too_slow" | "crashed";

/* Thrown where an operation does not fit; operations.ts answers it. */
export class Refusal extends Error {
    readonly problem: Problem;
    constructor(code: string, place: string, message: string) {
        super(message);
        this.problem = { code, place, message };
    }
}
