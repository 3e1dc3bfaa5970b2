/* SPDX-License-Identifier: MIT */
/* A picture of the scene as a file: how large, which outputs, how good, in which format. */
import { Download } from "lucide-react";
import { type ReactNode, useEffect, useRef, useState } from "react";
import { download } from "../../link/rest.ts";
import { printCamera } from "../../model/camera.ts";
import {
    extensionOf,
    FIRST_CHOICE,
    FORMATS,
    type Format,
    type PictureChoice,
    SIZES,
    toggleOutput,
    whyNotPicture,
} from "../../model/picture.ts";
import { findParam, limitOf, numberParam, valueIn } from "../../model/schema.ts";
import { sectionMember } from "../../model/section.ts";
import type { Editor } from "../editor.ts";
import { EnumField } from "../fields/Enum.tsx";
import { FlagField } from "../fields/Flag.tsx";
import { NumberField } from "../fields/Number.tsx";
import { outputTitle, typeTitle } from "../names.ts";
import { useDocument, useEditor, useLink, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { Dialog } from "../widgets/Dialog.tsx";
import { Select } from "../widgets/Select.tsx";
import "./palettes.css";

export function PictureDialog() {
    const { stores } = useEditor();
    const open = useView((view) => view.popup === "picture");
    const [choice, setChoice] = useState<PictureChoice | null>(null);
    const transparent = useDocument(({ document }) => document?.render.transparent === true);
    return (
        <Dialog
            open={open}
            title={t("picture.title")}
            wide
            closeLabel={t("close")}
            onClose={() => stores.view.setState({ popup: null })}
        >
            <Sheet choice={choice ?? { ...FIRST_CHOICE, transparent }} onChange={setChoice} />
        </Dialog>
    );
}

interface Props {
    choice: PictureChoice;
    onChange: (choice: PictureChoice) => void;
}

function Sheet({ choice, onChange }: Props) {
    const set = (part: Partial<PictureChoice>): void => onChange({ ...choice, ...part });
    const label = t("picture.transparent");
    return (
        <>
            <div className="picture-sheet">
                <div className="picture-form">
                    <Size choice={choice} onChange={onChange} />
                    <Level choice={choice} onChange={onChange} />
                    <Line title={t("picture.format")}>
                        <EnumField
                            label={t("picture.format")}
                            choices={FORMATS}
                            {...plain<string>(choice.format, (format) =>
                                set({ format: format as Format }),
                            )}
                        />
                    </Line>
                    <Line title={label}>
                        <FlagField
                            label={label}
                            {...plain(choice.transparent, (transparent) => set({ transparent }))}
                        />
                    </Line>
                </div>
                <Outputs choice={choice} onChange={onChange} />
            </div>
            <Foot choice={choice} />
        </>
    );
}

const ignore = (): void => undefined;

/* What a field outside of forms gets: each value is taken at once. */
function plain<T>(value: T, take: (value: T) => void) {
    return {
        value,
        fallback: value,
        onInput: take,
        onCommit: take,
        onCancel: ignore,
        onRefuse: ignore,
    };
}

function Line({ title, children }: { title: string; children: ReactNode }) {
    return (
        <div className="form-row">
            <span className="form-label">{title}</span>
            <div className="form-field">{children}</div>
        </div>
    );
}

const CUSTOM = "custom";

function Size({ choice, onChange }: Props) {
    const most = useDocument(({ schema }) => limitOf(schema, "image_side", 16384));
    const shown = useLink(({ frame: { width, height, scale } }) =>
        [width, height].map((side) => Math.round(side / scale)).join(" × "),
    );
    const sizes = SIZES.map(([width, height]) => `${width} × ${height}`);
    const size = `${choice.width} × ${choice.height}`;
    const take = (text: string): void => {
        const [width = 0, height = 0] = text.split(" × ").map(Number);
        if (width > 0 && height > 0) {
            onChange({ ...choice, width, height });
        }
    };
    const side = (name: "width" | "height") => (
        <NumberField
            label={t(`picture.${name}`)}
            param={numberParam(name, { type: "int", min: 1, max: most })}
            {...plain(choice[name], (value) => onChange({ ...choice, [name]: value }))}
        />
    );
    return (
        <>
            <Line title={t("picture.size")}>
                <Select
                    label={t("picture.size")}
                    value={sizes.includes(size) ? size : size === shown ? shown : CUSTOM}
                    options={[
                        ...sizes.map((value) => ({ value, label: value })),
                        { value: shown, label: t("picture.asShown", { size: shown }) },
                        { value: CUSTOM, label: t("picture.custom") },
                    ]}
                    onChange={take}
                />
            </Line>
            <Line title={t("picture.pixels")}>
                {side("width")}
                <span aria-hidden="true">×</span>
                {side("height")}
            </Line>
        </>
    );
}

const OF_SCENE = "";

function Level({ choice, onChange }: Props) {
    const levels = useDocument(({ schema }) => schema.levels);
    const own = useDocument(({ schema, document }) => {
        const param = findParam(schema.render, "level");
        return param && document ? String(valueIn(document.render, param)) : "";
    });
    const doc = levels.find(({ name }) => name === (choice.level ?? own))?.doc;
    return (
        <>
            <Line title={t("picture.level")}>
                <Select
                    label={t("picture.level")}
                    value={choice.level ?? OF_SCENE}
                    options={[
                        { value: OF_SCENE, label: t("picture.levelOfScene", { level: own }) },
                        ...levels.map(({ name }) => ({ value: name, label: typeTitle(name) })),
                    ]}
                    onChange={(level) =>
                        onChange({ ...choice, level: level === OF_SCENE ? null : level })
                    }
                />
            </Line>
            {doc && <p className="form-note picture-note">{doc}</p>}
        </>
    );
}

function Outputs({ choice, onChange }: Props) {
    const outputs = useDocument(({ schema }) => schema.outputs);
    return (
        <fieldset className="picture-outputs">
            <legend>{t("picture.outputs")}</legend>
            {outputs.map(({ name, doc }) => (
                <label key={name} className="picture-output" title={doc}>
                    <input
                        type="checkbox"
                        checked={choice.outputs.includes(name)}
                        onChange={() => onChange(toggleOutput(choice, name))}
                    />
                    {outputTitle(name)}
                </label>
            ))}
        </fieldset>
    );
}

/* What comes, and the button; a press while it is drawn gives it up. */
function Foot({ choice }: { choice: PictureChoice }) {
    const editor = useEditor();
    const whyNot = useDocument(({ schema }) => whyNotPicture(schema, choice));
    const [failed, setFailed] = useState<string | null>(null);
    const [busy, setBusy] = useState(false);
    const request = useRef<AbortController | null>(null);
    useEffect(() => () => request.current?.abort(), []);
    const start = async (): Promise<void> => {
        request.current = new AbortController();
        setFailed(null);
        setBusy(true);
        const { signal } = request.current;
        const reason = await save(editor, choice, signal).catch((error: unknown) => error);
        setBusy(false);
        setFailed(reason instanceof Error && !signal.aborted ? reason.message : null);
    };
    const message = whyNot ?? failed;
    return (
        <footer className="dialog-foot">
            <p role="status" data-bad={message !== null || undefined}>
                {message ?? t(busy ? "picture.drawing" : "picture.ready", summary(choice))}
            </p>
            {busy ? (
                <Button look="outline" onClick={() => request.current?.abort()}>
                    {t("picture.cancel")}
                </Button>
            ) : (
                <Button
                    look="primary"
                    icon={<Download size={15} />}
                    disabled={whyNot !== null}
                    onClick={() => void start()}
                >
                    {t("picture.download")}
                </Button>
            )}
        </footer>
    );
}

function summary(choice: PictureChoice) {
    const { width, height } = choice;
    return { width, height, extension: extensionOf(choice).toUpperCase() };
}

/* From where the view is seen from, cut as it is. */
async function save(editor: Editor, choice: PictureChoice, signal: AbortSignal): Promise<void> {
    const { scene, document } = editor.stores.document.getState();
    const { camera, own } = editor.stores.camera.getState();
    const { level, ...rest } = choice;
    const url = editor.rest.imageUrl(scene ?? "", {
        ...rest,
        ...(level === null ? {} : { level }),
        ...(own ? { camera: printCamera(camera) } : {}),
        ...sectionMember(editor.stores.view.getState().section),
    });
    const blob = await editor.rest.fetchFile(url, signal);
    download(String(document?.info.name ?? scene), extensionOf(choice), blob);
}
