/* SPDX-License-Identifier: MIT */
/* A text that the picture follows while it is typed: sent after a pause, taken by Enter and where the
 * field is left, given up by Escape. What cannot be taken stays in the field. */
import { type ChangeEvent, type KeyboardEvent, useEffect, useRef, useState } from "react";

/* A pause in typing after which the text is sent. */
const SEND_MS = 250;

interface Options {
    text: string;
    /* Enter with the shift key is a new line. */
    lines?: boolean;
    onInput: (text: string) => void;
    onCommit: (text: string) => void;
    onCancel: () => void;
    /* Why a text cannot be taken, or null where it can; `onRefuse` is told the same. */
    whyNot?: (text: string) => string | null;
    onRefuse?: (reason: string | null) => void;
}

type Area = HTMLInputElement | HTMLTextAreaElement;

/* `shown` is what the field shows; the rest are its listeners. */
export function useTypedText(options: Options) {
    const { text, lines = false, onInput, onCommit, onCancel, whyNot, onRefuse } = options;
    const [draft, setDraft] = useState<string | null>(null);
    const timer = useRef<ReturnType<typeof setTimeout> | undefined>(undefined);
    useEffect(() => () => clearTimeout(timer.current), []);
    const isRefused = (typed: string): boolean => {
        const reason = whyNot?.(typed) ?? null;
        onRefuse?.(reason);
        return reason !== null;
    };
    const send = (typed: string): void => {
        if (!isRefused(typed)) {
            onInput(typed);
        }
    };
    const end = (take: boolean): void => {
        clearTimeout(timer.current);
        if (take && draft !== null && isRefused(draft)) {
            return;
        }
        onRefuse?.(null);
        if (draft !== null) {
            take ? onCommit(draft) : onCancel();
        }
        setDraft(null);
    };
    return {
        shown: draft ?? text,
        isTyped: draft !== null,
        listeners: {
            onChange: ({ target }: ChangeEvent<Area>) => {
                setDraft(target.value);
                clearTimeout(timer.current);
                timer.current = setTimeout(() => send(target.value), SEND_MS);
            },
            onBlur: () => end(true),
            onKeyDown: (event: KeyboardEvent<Area>) => {
                if (event.key === "Enter" && !(lines && event.shiftKey)) {
                    event.preventDefault();
                    end(true);
                } else if (event.key === "Escape" && draft !== null) {
                    event.stopPropagation();
                    end(false);
                }
            },
        },
    };
}
