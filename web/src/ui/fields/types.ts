/* SPDX-License-Identifier: MIT */
/* What every field gets. A gesture is any number of `onInput` calls ended by one `onCommit` or one
 * `onCancel`; a typed value is a commit alone. The form turns a gesture into one undo step. */
export interface FieldProps<T> {
    label: string;
    value: T;
    fallback: T;
    describedBy?: string;
    onInput: (value: T) => void;
    onCommit: (value: T) => void;
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
