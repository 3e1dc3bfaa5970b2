/* SPDX-License-Identifier: MIT */
/* A command as an icon button or a menu item: title, key and reason come from the table. */
import type { ReactNode } from "react";
import { commandById, runCommand, whyNotNow } from "../../model/commandLookup.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { Button, IconButton } from "../widgets/Button.tsx";
import { MenuItem } from "../widgets/Menu.tsx";
import { useKeyText } from "./keys.ts";

interface Props {
    id: string;
    /* In the place of the command's own. */
    title?: string;
    children?: ReactNode;
}

/* Renders anew when what commands depend on has changed. */
function useReason(id: string, whyNot = whyNotNow): string | null {
    const editor = useEditor();
    useDocument((state) => state.document === null);
    useDocument((state) => state.document?.camera);
    useDocument((state) => state.canUndo);
    useDocument((state) => state.canRedo);
    useView((view) => view.selection);
    useView((view) => view.held);
    const command = commandById(id);
    return command && whyNot(editor, command);
}

export function ActButton({ id, title, children }: Props) {
    const editor = useEditor();
    const command = commandById(id);
    const reason = useReason(id);
    const keys = useKeyText(id);
    return (
        command && (
            <IconButton
                title={title ?? command.title}
                keys={keys}
                whyNot={reason}
                data-command={id}
                onClick={() => runCommand(editor, command)}
            >
                {children}
            </IconButton>
        )
    );
}

/* With its words; left out while it cannot run, but not for as long as a hand holds something. */
export function CommandButton({ id }: Props) {
    const editor = useEditor();
    const command = commandById(id);
    const reason = useReason(id, (app, { whyNot }) => whyNot(app));
    return (
        command &&
        reason === null && (
            <Button look="outline" data-command={id} onClick={() => runCommand(editor, command)}>
                {command.title}
            </Button>
        )
    );
}

interface ItemProps {
    id: string;
    danger?: boolean;
    icon?: ReactNode;
    /* Left out while it cannot run, as in a menu for what is under the pointer. */
    onlyIfAble?: boolean;
}

export function ActItem({ id, danger, icon, onlyIfAble }: ItemProps) {
    const editor = useEditor();
    const command = commandById(id);
    const reason = useReason(id);
    const keys = useKeyText(id);
    const shown = onlyIfAble !== true || reason === null;
    return (
        command &&
        shown && (
            <MenuItem
                icon={icon}
                danger={danger}
                keys={keys}
                disabled={reason !== null}
                onSelect={() => runCommand(editor, command)}
            >
                {command.title}
            </MenuItem>
        )
    );
}
