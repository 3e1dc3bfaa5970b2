/* SPDX-License-Identifier: MIT */
/* The preset materials as balls, and those of the library: what is active is shown on the node,
 * without an edit; a click takes it, a drag puts it on something. */
import { useCallback, useEffect, useRef } from "react";
import type { EntryRow } from "../../model/libraryEntries.ts";
import { PRESET_GROUPS, PRESETS, type Preset } from "../../model/presets.ts";
import { newResource } from "../../model/resources.ts";
import { search } from "../../model/search.ts";
import type { Trial } from "../../model/view.ts";
import type { Editor } from "../editor.ts";
import { addResource } from "../insertions.ts";
import { take } from "../library/actions.ts";
import { EntryPicture } from "../library/EntryPicture.tsx";
import { useEntries } from "../library/entries.ts";
import { typeTitle } from "../names.ts";
import { type Face, type Group, PaletteBody } from "../palettes/Palette.tsx";
import { useEditor } from "../state.ts";
import { fillText, t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { useBall } from "./balls.ts";
import { dragPreset } from "./drag.ts";
import { TEXTS } from "./texts.ts";
import "./materials.css";

interface Props {
    /* The place that is to name it; null: none. */
    use: string | null;
    onClose: () => void;
}

/* A preset, or a material of the library. */
type Choice = Preset | EntryRow;

const isEntry = (choice: Choice): choice is EntryRow => "id" in choice;

export default function Gallery({ use, onClose }: Props) {
    const editor = useEditor();
    const { view } = editor.stores;
    const field = useRef<HTMLInputElement>(null);
    useEffect(() => {
        field.current?.focus({ preventScroll: true });
        return () => view.setState({ trial: null });
    }, [view]);
    const entries = useEntries(true);
    const find = useCallback(
        (query: string) =>
            findIn(
                entries.filter(({ kind }) => kind === "material"),
                query,
            ),
        [entries],
    );
    const tryOut = useCallback(
        (choice: Choice | null) => {
            const preset = choice && !isEntry(choice) ? choice : null;
            view.setState({ trial: preset && use !== null ? trialOf(editor, preset, use) : null });
        },
        [editor, view, use],
    );
    return (
        <div className="gallery" data-testid="gallery">
            <PaletteBody
                title={t("gallery.title")}
                placeholder={TEXTS.search}
                grid
                field={field}
                find={find}
                faceOf={faceOf}
                footOf={() => <Foot use={use} onClose={onClose} />}
                onActive={tryOut}
                onTake={(choice) =>
                    isEntry(choice)
                        ? take(editor, choice, { use, selection: [] })
                        : addResource(editor, "materials", use, choice)
                }
                onClose={onClose}
            />
        </div>
    );
}

/* A preset at the place that would name the material. */
function trialOf({ stores }: Editor, preset: Preset, use: string): Trial | null {
    const { document, schema } = stores.document.getState();
    if (document === null) {
        return null;
    }
    const { name } = preset;
    const { ops } = newResource(document, schema, "materials", use, [], "union", preset);
    return { ops, name, words: fillText(TEXTS.trying, { name: typeTitle(name) }) };
}

function findIn(entries: readonly EntryRow[], query: string): readonly Group<Choice>[] {
    if (query.trim() !== "") {
        const items = search<Choice>([...entries, ...PRESETS], query, (choice) =>
            isEntry(choice)
                ? { name: choice.name, words: t("library.title") }
                : { name: typeTitle(choice.name), words: TEXTS[choice.group], doc: "" },
        );
        return [{ title: t("add.results"), items }];
    }
    const presets = PRESET_GROUPS.map((group) => ({
        title: TEXTS[group],
        items: PRESETS.filter((preset) => preset.group === group),
    }));
    return [{ title: t("library.title"), items: entries }, ...presets];
}

function faceOf(choice: Choice): Face {
    const className = "gallery-tile";
    return isEntry(choice)
        ? {
              key: `library/${choice.id}`,
              className,
              data: { "data-entry": choice.id },
              content: <EntryTile entry={choice} />,
          }
        : {
              key: choice.name,
              className,
              data: { "data-preset": choice.name },
              onDragStart: dragPreset(choice.name),
              content: <Tile preset={choice} />,
          };
}

function EntryTile({ entry }: { entry: EntryRow }) {
    return (
        <>
            <span className="gallery-ball">
                <EntryPicture entry={entry} />
            </span>
            <span className="ellipsis">{entry.name}</span>
        </>
    );
}

function Tile({ preset }: { preset: Preset }) {
    const ball = useBall(preset);
    return (
        <>
            <span className="gallery-ball">
                {ball && <img src={ball} alt="" draggable={false} />}
            </span>
            <span className="ellipsis">{typeTitle(preset.name)}</span>
        </>
    );
}

function Foot({ use, onClose }: Props) {
    const editor = useEditor();
    return (
        <>
            <span className="palette-what">{use === null ? TEXTS.what : TEXTS.whatTry}</span>
            <Button
                data-size="s"
                onClick={() => {
                    onClose();
                    addResource(editor, "materials", use);
                }}
            >
                {t("materials.plain")}
            </Button>
        </>
    );
}
