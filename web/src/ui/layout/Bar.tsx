/* SPDX-License-Identifier: MIT */
/* The bar: scenes, the scene's name, undo, Add, search, theme, files, help. */
import {
    Bookmark,
    Braces,
    ChevronDown,
    CircleHelp,
    Copy,
    FileImage,
    FileJson,
    LayoutGrid,
    Monitor,
    Moon,
    Pencil,
    Plus,
    Redo2,
    Search,
    Sun,
    Undo2,
    Upload,
} from "lucide-react";
import { useRef, useState } from "react";
import { redoTitle, undoTitle } from "../../model/history.ts";
import { setPreferences } from "../../model/stores.ts";
import type { Theme } from "../../model/view.ts";
import { useNameCut } from "../fields/nameCut.ts";
import { report } from "../files.ts";
import { addressOf, follow, goTo } from "../route.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Button, IconButton } from "../widgets/Button.tsx";
import { Logo } from "../widgets/Logo.tsx";
import { Menu, MenuItem, MenuLine } from "../widgets/Menu.tsx";
import { Tip } from "../widgets/Tip.tsx";
import { ActButton, ActItem } from "./Act.tsx";
import { useKeyText } from "./keys.ts";
import { Region } from "./Region.tsx";
import { Saved } from "./Saved.tsx";
import "./layout.css";

export function Bar({ narrow }: { narrow: boolean }) {
    return (
        <Region as="header" name={t("region.bar")} className="bar">
            <Tip text={t("bar.scenes")} keys={useKeyText("scene.open")}>
                <a
                    className="bar-logo"
                    href={addressOf(null)}
                    onClick={follow(null)}
                    aria-label={t("bar.scenes")}
                >
                    <Logo size={20} />
                </a>
            </Tip>
            <Name />
            <span className="bar-line" />
            <History />
            <AddButton narrow={narrow} />
            <span className="bar-space" />
            <SearchButton narrow={narrow} />
            <span className="bar-space" />
            {narrow ? <Saved compact /> : <ThemeButton />}
            {!narrow && <HelpButton />}
        </Region>
    );
}

function Name() {
    const editor = useEditor();
    const name = useDocument((state) => state.document?.info.name as string | undefined);
    const scene = useDocument((state) => state.scene);
    const [draft, setDraft] = useState<string | null>(null);
    const cut = useNameCut();
    /* The key that ends the typing takes the focus back to the button. */
    const byKey = useRef(false);
    const commit = (): void => {
        if (draft !== null && draft !== (name ?? "")) {
            const ops = [{ op: "set" as const, at: "/name", value: draft === "" ? null : draft }];
            editor.link.edit(ops, { label: t("edit.rename", { name: name ?? t("bar.untitled") }) });
        }
        setDraft(null);
    };
    if (draft !== null) {
        return (
            <label className="bar-name bar-name-edit" data-text={draft}>
                <input
                    className="bar-name-input"
                    aria-label={t("bar.rename")}
                    // biome-ignore lint/a11y/noAutofocus: the user has just asked to type here
                    autoFocus
                    value={draft}
                    onFocus={(event) => event.currentTarget.select()}
                    onChange={(event) => setDraft(cut(event.target))}
                    onBlur={commit}
                    onKeyDown={(event) => {
                        byKey.current = event.key === "Enter" || event.key === "Escape";
                        if (event.key === "Enter") {
                            /* It would press the button. */
                            event.preventDefault();
                            commit();
                        } else if (event.key === "Escape") {
                            event.stopPropagation();
                            setDraft(null);
                        }
                    }}
                />
            </label>
        );
    }
    const focusAgain = (button: HTMLButtonElement | null): void => {
        if (button !== null && byKey.current) {
            byKey.current = false;
            button.focus();
        }
    };
    return (
        <div className="bar-name">
            <Menu
                trigger={
                    <Button ref={focusAgain}>
                        <span className="ellipsis">{name ?? scene ?? t("bar.untitled")}</span>
                        <ChevronDown size={14} aria-hidden="true" />
                    </Button>
                }
            >
                <SceneMenu onRename={() => setDraft(name ?? "")} />
            </Menu>
        </div>
    );
}

function SceneMenu({ onRename }: { onRename: () => void }) {
    const editor = useEditor();
    const scene = useDocument((state) => state.scene);
    const copy = async (): Promise<void> => {
        try {
            goTo(await editor.rest.createFromScene(scene ?? ""));
        } catch (error) {
            report(editor, error);
        }
    };
    return (
        <>
            <MenuItem icon={<Pencil size={14} />} onSelect={onRename}>
                {t("scenes.rename")}
            </MenuItem>
            <MenuItem icon={<Copy size={14} />} onSelect={() => void copy()}>
                {t("bar.duplicate")}
            </MenuItem>
            <MenuLine />
            <MenuItem icon={<FileJson size={14} />} onSelect={() => editor.download()}>
                {t("bar.downloadJson")}
            </MenuItem>
            <MenuItem
                icon={<FileImage size={14} />}
                keys={useKeyText("scene.picture")}
                onSelect={() => editor.stores.view.setState({ popup: "picture" })}
            >
                {t("bar.downloadPicture")}
            </MenuItem>
            <MenuItem icon={<Upload size={14} />} onSelect={() => editor.upload()}>
                {t("bar.upload")}
            </MenuItem>
            <MenuLine />
            <ActItem id="view.text" icon={<Braces size={14} />} />
            <ActItem id="scene.open" icon={<LayoutGrid size={14} />} />
            <ActItem id="library.open" icon={<Bookmark size={14} />} />
            <ActItem id="view.theme" icon={<Sun size={14} />} />
            <ActItem id="help.keys" icon={<CircleHelp size={14} />} />
        </>
    );
}

function History() {
    const undo = useDocument((state) => undoTitle(state.history));
    const redo = useDocument((state) => redoTitle(state.history));
    return (
        <>
            <ActButton id="edit.undo" title={undo}>
                <Undo2 size={16} />
            </ActButton>
            <ActButton id="edit.redo" title={redo}>
                <Redo2 size={16} />
            </ActButton>
        </>
    );
}

function AddButton({ narrow }: { narrow: boolean }) {
    const editor = useEditor();
    return (
        <Tip text={t("add.title")} keys={useKeyText("node.add")}>
            <Button
                look="primary"
                icon={<Plus size={15} strokeWidth={2.4} />}
                data-command="node.add"
                aria-label={narrow ? t("bar.add") : undefined}
                onClick={() => editor.stores.view.setState({ popup: "add" })}
            >
                {!narrow && t("bar.add")}
            </Button>
        </Tip>
    );
}

function SearchButton({ narrow }: { narrow: boolean }) {
    const editor = useEditor();
    const keys = useKeyText("palette.open");
    const open = (): void => editor.stores.view.setState({ popup: "commands" });
    if (narrow) {
        return (
            <IconButton title={t("bar.search")} onClick={open}>
                <Search size={16} />
            </IconButton>
        );
    }
    return (
        <button type="button" className="search-button" onClick={open}>
            <Search size={14} aria-hidden="true" />
            <span className="ellipsis">{t("bar.search")}</span>
            <kbd>{keys}</kbd>
        </button>
    );
}

const themes: readonly Theme[] = ["auto", "light", "dark"];
const themeIcons = { auto: Monitor, light: Sun, dark: Moon };

export function ThemeButton() {
    const { stores } = useEditor();
    const theme = useView((view) => view.preferences.theme);
    const Icon = themeIcons[theme];
    const next = themes[(themes.indexOf(theme) + 1) % themes.length] ?? "auto";
    return (
        <IconButton
            title={t("bar.theme", { theme: t(`theme.${theme}`) })}
            onClick={() => setPreferences(stores.view, { theme: next })}
        >
            <Icon size={16} />
        </IconButton>
    );
}

function HelpButton() {
    const editor = useEditor();
    return (
        <IconButton
            title={t("bar.help")}
            keys="?"
            onClick={() => editor.stores.view.setState({ popup: "help" })}
        >
            <CircleHelp size={16} />
        </IconButton>
    );
}
