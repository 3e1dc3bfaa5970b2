/* SPDX-License-Identifier: MIT */
/* Cards of the start page: a picture, a name, and for own scenes what can be done with them. */
import { Copy, Download, Ellipsis, Pencil, Trash2 } from "lucide-react";
import { useEffect, useRef, useState } from "react";
import type { ExampleEntry, SceneEntry } from "../../link/rest.ts";
import { useNameCut } from "../fields/nameCut.ts";
import { downloadJson, report } from "../files.ts";
import { addressOf, follow } from "../route.ts";
import { useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { Button, IconButton } from "../widgets/Button.tsx";
import { Menu, MenuItem, MenuLine } from "../widgets/Menu.tsx";
import { age } from "./age.ts";
import { PICTURE_HEIGHT, PICTURE_WIDTH, Picture } from "./Picture.tsx";
import { timeOf } from "./Scenes.tsx";
import "./scenes.css";

/* How long a deleted scene can be taken back. */
const UNDO_MS = 10_000;

/* Numbers stay in the line of what they count. */
const joined = (text: string): string => text.replaceAll(/(\d) /g, "$1\u00a0");

interface ExampleProps {
    example: ExampleEntry;
    onOpen: () => void;
}

export function ExampleCard({ example, onOpen }: ExampleProps) {
    const { rest } = useEditor();
    return (
        <li className="card" data-example={example.id}>
            <button type="button" className="card-open" onClick={onOpen}>
                <Picture url={rest.exampleImageUrl(example.id)} />
                <span className="card-text">
                    <span className="card-name">{example.name || example.id}</span>
                </span>
                <span className="card-meta card-doc">{joined(example.description)}</span>
            </button>
        </li>
    );
}

interface SceneProps {
    scene: SceneEntry;
    /* Of all cards, so that their ages agree. */
    now: number;
    onChange: () => void;
    onLeave: () => void;
}

export function SceneCard({ scene, now, onChange, onLeave }: SceneProps) {
    const editor = useEditor();
    const { rest } = editor;
    const [renaming, setRenaming] = useState(false);
    const { id } = scene;
    const name = scene.name || id;
    const attempt = (act: () => Promise<unknown>) => async (): Promise<void> => {
        try {
            await act();
            onChange();
        } catch (error) {
            report(editor, error);
        }
    };
    const rename = (text: string): void => {
        setRenaming(false);
        if (text !== scene.name) {
            void attempt(() =>
                rest.editScene(id, [{ op: "set", at: "/name", value: text || null }]),
            )();
        }
    };
    const picture = rest.imageUrl(id, {
        width: PICTURE_WIDTH,
        height: PICTURE_HEIGHT,
        format: "jpg",
    });
    return (
        <li className="card" data-scene={id}>
            <a className="card-open" href={addressOf(id)} onClick={follow(id)} aria-label={name}>
                <Picture key={scene.revision} url={picture} slow />
            </a>
            <div className="card-text">
                {renaming ? (
                    <RenameField name={name} onDone={rename} onCancel={() => setRenaming(false)} />
                ) : (
                    <span className="card-name ellipsis">{name}</span>
                )}
                <Menu
                    align="end"
                    trigger={
                        <IconButton title={t("scenes.more", { name })} data-size="s">
                            <Ellipsis size={15} />
                        </IconButton>
                    }
                >
                    <MenuItem icon={<Pencil size={14} />} onSelect={() => setRenaming(true)}>
                        {t("scenes.rename")}
                    </MenuItem>
                    <MenuItem
                        icon={<Copy size={14} />}
                        onSelect={() => void attempt(() => rest.createFromScene(id))()}
                    >
                        {t("scenes.duplicate")}
                    </MenuItem>
                    <MenuItem
                        icon={<Download size={14} />}
                        onSelect={() =>
                            void attempt(async () => downloadJson(name, await rest.readScene(id)))()
                        }
                    >
                        {t("bar.downloadJson")}
                    </MenuItem>
                    <MenuLine />
                    <MenuItem icon={<Trash2 size={14} />} danger onSelect={onLeave}>
                        {t("scenes.delete")}
                    </MenuItem>
                </Menu>
            </div>
            <span className="card-meta">
                {t("scenes.meta", {
                    count: scene.nodes,
                    nodes: scene.nodes,
                    age: age(timeOf(scene), now),
                })}
                {scene.viewers > 0 && ` · ${t("scenes.viewers", { count: scene.viewers })}`}
            </span>
        </li>
    );
}

interface RenameProps {
    name: string;
    onDone: (name: string) => void;
    onCancel: () => void;
}

export function RenameField({ name, onDone, onCancel }: RenameProps) {
    const cut = useNameCut();
    return (
        <input
            className="text-field"
            aria-label={t("scenes.nameOf", { name })}
            // biome-ignore lint/a11y/noAutofocus: the user has just asked to type here
            autoFocus
            defaultValue={name}
            onInput={(event) => cut(event.currentTarget)}
            onFocus={(event) => event.currentTarget.select()}
            onBlur={(event) => onDone(event.currentTarget.value.trim())}
            onKeyDown={(event) => {
                event.stopPropagation();
                if (event.key === "Enter") {
                    event.currentTarget.blur();
                } else if (event.key === "Escape") {
                    onCancel();
                }
            }}
        />
    );
}

interface LeavingProps {
    name: string;
    onUndo: () => void;
    onGone: () => void;
}

/* A deleted scene's last ten seconds. */
export function Leaving({ name, onUndo, onGone }: LeavingProps) {
    const gone = useRef(onGone);
    gone.current = onGone;
    useEffect(() => {
        const timer = setTimeout(() => gone.current(), UNDO_MS);
        return () => clearTimeout(timer);
    }, []);
    return (
        <div className="notice popup leaving" role="status">
            <Trash2 size={15} aria-hidden="true" />
            <span className="notice-text">{t("scenes.deleted", { name })}</span>
            <Button onClick={onUndo}>{t("undo.act")}</Button>
        </div>
    );
}
