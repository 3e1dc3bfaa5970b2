/* SPDX-License-Identifier: MIT */
/* The preset materials as balls: what is active is shown on the node, without an edit; a click takes
 * it, a drag puts it on something. */
import { useCallback, useEffect, useRef } from "react";
import { PRESET_GROUPS, PRESETS, type Preset } from "../../model/presets.ts";
import { search } from "../../model/search.ts";
import { addResource } from "../insertions.ts";
import { typeTitle } from "../names.ts";
import { type Face, type Group, PaletteBody } from "../palettes/Palette.tsx";
import { useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { useBall } from "./balls.ts";
import { dragPreset } from "./drag.ts";
import "./materials.css";

interface Props {
    /* The place that is to name it; null: none. */
    use: string | null;
    onClose: () => void;
}

export default function Gallery({ use, onClose }: Props) {
    const editor = useEditor();
    const { view } = editor.stores;
    const field = useRef<HTMLInputElement>(null);
    useEffect(() => {
        field.current?.focus({ preventScroll: true });
        return () => view.setState({ trial: null });
    }, [view]);
    const tryOut = useCallback(
        (preset: Preset | null) =>
            view.setState({ trial: preset && use !== null ? { preset, use } : null }),
        [view, use],
    );
    return (
        <div className="gallery" data-testid="gallery">
            <PaletteBody
                title={t("gallery.title")}
                placeholder={t("gallery.search")}
                grid
                field={field}
                find={find}
                faceOf={faceOf}
                footOf={() => <Foot use={use} onClose={onClose} />}
                onActive={tryOut}
                onTake={(preset) => addResource(editor, "materials", use, preset)}
                onClose={onClose}
            />
        </div>
    );
}

function find(query: string): readonly Group<Preset>[] {
    if (query.trim() !== "") {
        const items = search(PRESETS, query, ({ name, group }) => ({
            name: typeTitle(name),
            words: t(`gallery.${group}`),
            doc: "",
        }));
        return [{ title: t("add.results"), items }];
    }
    return PRESET_GROUPS.map((group) => ({
        title: t(`gallery.${group}`),
        items: PRESETS.filter((preset) => preset.group === group),
    }));
}

function faceOf(preset: Preset): Face {
    return {
        key: preset.name,
        className: "gallery-tile",
        data: { "data-preset": preset.name },
        onDragStart: dragPreset(preset.name),
        content: <Tile preset={preset} />,
    };
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
            <span className="palette-what ellipsis">
                {t(use === null ? "gallery.what" : "gallery.whatTry")}
            </span>
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
