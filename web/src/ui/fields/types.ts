/* SPDX-License-Identifier: MIT */
import type { Change } from "../../model/multiEdit.ts";

/* What every field gets. A gesture is any number of `onInput` calls ended by one `onCommit` or one
 * `onCancel`; a typed value is a commit alone. The form turns a gesture into one undo step. */
export interface FieldProps<T, C = Change> {
    /* Where selected nodes differ: a digit for each component, 1 where they do; "" or absent:
     * nowhere. */
    mixed?: string;
    label: string;
    value: T;
    fallback: T;
    describedBy?: string;
    /* `change`: how the same values of other selected nodes follow; without, they become `value`. */
    onInput: (value: T, change?: C) => void;
    onCommit: (value: T, change?: C) => void;
    onCancel: () => void;
    /* A typed value that cannot be taken: what to tell, null when all is well again. */
    onRefuse: (message: string | null) => void;
}

/* How a number is bounded and stepped, in the unit of the document. */
export interface Range {
    min?: number;
    max?: number;
    aboveMin?: boolean;
    nonzero?: boolean;
    step?: number;
    whole?: boolean;
}
