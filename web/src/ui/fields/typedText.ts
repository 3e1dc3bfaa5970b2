/* SPDX-License-Identifier: MIT */
/* A text that the picture follows while it is typed: sent after a pause, taken by Enter and where the
 * field is left, given up by Escape. What cannot be taken stays in the field. */
import {
    type ChangeEvent,
    type KeyboardEvent,
    useCallback,
    useEffect,
    useRef,
    useState,
} from "react";
import { keptOf, settleRefusal, useRefusal } from "../kept.ts";
import { useEditor } from "../state.ts";

/* A pause in typing after which the text is sent. */
const SEND_MS = 250;

interface Options {
    /* Where the server says what is wrong with the text. */
    place: string;
    text: string;
    /* Selected nodes differ: the field is empty, and stays without meaning while it is. */
    mixed?: boolean;
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

/* What the server has refused comes back into the field, also when it is shown again, until the text
 * becomes another one. `show` null: nothing does any longer. */
function useRefused(place: string, text: string, show: (text: string | null) => void) {
    const editor = useEditor();
    const { sent, refusal, problem } = useRefusal(place, text);
    /* And what the field had instead. */
    const refused = useRef<{ readonly text: string; readonly instead: string } | null>(null);
    const latest = useRef({ text, show });
    latest.current = { text, show };
    const put = useCallback((back: string): void => {
        refused.current = { text: back, instead: latest.current.text };
        latest.current.show(back);
    }, []);
    useEffect(() => {
        const kept = keptOf(editor, place);
        const old = kept.take();
        if (old !== null) {
            put(old.text);
        }
        return () => {
            const left = refused.current?.text ?? sent.current;
            if (left !== null) {
                kept.put({ text: left, problem: null });
            }
        };
    }, [editor, place, sent, put]);
    const back = refusal?.text ?? null;
    useEffect(() => {
        if (back !== null) {
            put(back);
        }
    }, [back, put]);
    useEffect(() => {
        if (refused.current !== null && refused.current.instead !== text) {
            refused.current = null;
            latest.current.show(null);
        }
    }, [text]);
    return {
        is: (typed: string): boolean => problem !== null && typed === refused.current?.text,
        sends: (typed: string): void => {
            refused.current = null;
            sent.current = typed;
        },
        giveUp: (): void => {
            if (refused.current !== null) {
                settleRefusal(editor, place);
            }
            refused.current = null;
            sent.current = null;
        },
    };
}

/* `shown` is what the field shows; the rest are its listeners. */
export function useTypedText(options: Options) {
    const { place, text, mixed = false, lines = false } = options;
    const { onInput, onCommit, onCancel, whyNot, onRefuse } = options;
    const [draft, setDraft] = useState<string | null>(null);
    const timer = useRef<ReturnType<typeof setTimeout> | undefined>(undefined);
    const wasMixed = useRef(false);
    const refused = useRefused(place, text, (back) =>
        setDraft((now) => (back === null ? null : (now ?? back))),
    );
    useEffect(() => () => clearTimeout(timer.current), []);
    const isEmpty = (typed: string): boolean => typed === "" && wasMixed.current;
    const isBad = (typed: string): boolean => {
        const reason = whyNot?.(typed) ?? null;
        onRefuse?.(reason);
        return reason !== null;
    };
    const send = (typed: string): void => {
        if (isEmpty(typed)) {
            onRefuse?.(null);
            onCancel();
        } else if (!isBad(typed)) {
            refused.sends(typed);
            onInput(typed);
        }
    };
    const end = (wanted: boolean): void => {
        clearTimeout(timer.current);
        const take = wanted && draft !== null && !isEmpty(draft);
        if (take && (refused.is(draft) || isBad(draft))) {
            return;
        }
        onRefuse?.(null);
        if (take) {
            refused.sends(draft);
            onCommit(draft);
        } else if (draft !== null) {
            refused.giveUp();
            onCancel();
        }
        setDraft(null);
    };
    return {
        shown: draft ?? (mixed ? "" : text),
        isTyped: draft !== null,
        listeners: {
            onChange: ({ target }: ChangeEvent<Area>) => {
                wasMixed.current = draft === null ? mixed : wasMixed.current;
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
