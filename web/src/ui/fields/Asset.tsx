/* SPDX-License-Identifier: MIT */
/* An uploaded picture: put in by a button or dropped on the field, or one that is there already. */
import { ImageUp, X } from "lucide-react";
import { type DragEvent, useEffect, useState } from "react";
import type { Asset } from "../../link/rest.ts";
import { chooseFiles } from "../files.ts";
import { sceneKept } from "../opening.ts";
import { useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { Button, IconButton } from "../widgets/Button.tsx";
import { Select } from "../widgets/Select.tsx";
import { thumbnail } from "./thumbnail.ts";
import type { FieldProps } from "./types.ts";
import "./fields.css";

const ACCEPT = ".png,.hdr,image/png,image/vnd.radiance";
const NONE = "";

function assetTitle({ id, type, width, height }: Asset): string {
    const kind = type.endsWith("png") ? "PNG" : "HDR";
    return t("asset.name", { kind, width, height, id: id.slice(0, 6) });
}

export default function AssetField(props: FieldProps<string>) {
    const { label, value, describedBy, onCommit, onRefuse } = props;
    const editor = useEditor();
    const { rest } = editor;
    const [busy, setBusy] = useState(false);
    const [over, setOver] = useState(false);
    const [assets, refresh] = useAssets();
    const upload = async (files: readonly File[]): Promise<void> => {
        const [file] = files;
        if (file === undefined) {
            return;
        }
        setBusy(true);
        onRefuse(null);
        const isKept = sceneKept(editor);
        try {
            const { id } = await rest.uploadAsset(file);
            if (isKept()) {
                onCommit(id);
            }
            refresh();
        } catch (error) {
            onRefuse(t("asset.failed", { name: file.name, message: (error as Error).message }));
        }
        setBusy(false);
    };
    const drop = (event: DragEvent): void => {
        event.preventDefault();
        setOver(false);
        void upload([...event.dataTransfer.files]);
    };
    const known = assets.some(({ id }) => id === value);
    return (
        // biome-ignore lint/a11y/useSemanticElements: a fieldset brings a look and a legend of its own
        <div
            className="asset"
            role="group"
            aria-label={label}
            aria-describedby={describedBy}
            data-over={over || undefined}
            data-takes-files=""
            onDragOver={(event) => {
                event.preventDefault();
                setOver(true);
            }}
            onDragLeave={() => setOver(false)}
            onDrop={drop}
        >
            <Preview id={value} />
            <div className="asset-row">
                <Button
                    look="outline"
                    icon={<ImageUp size={14} />}
                    disabled={busy}
                    onClick={() =>
                        chooseFiles(ACCEPT, (files) => void upload(files.map(({ file }) => file)))
                    }
                >
                    {t(busy ? "asset.busy" : "asset.upload")}
                </Button>
                {value !== NONE && (
                    <IconButton
                        title={t("asset.remove")}
                        data-size="s"
                        onClick={() => onCommit(NONE)}
                    >
                        <X size={14} />
                    </IconButton>
                )}
            </div>
            {assets.length > 0 && (
                <Select
                    label={t("asset.choose")}
                    value={value}
                    options={[
                        { value: NONE, label: t("asset.none") },
                        ...assets.map((asset) => ({ value: asset.id, label: assetTitle(asset) })),
                        ...(known || value === NONE
                            ? []
                            : [{ value, label: t("asset.unknown", { id: value.slice(0, 6) }) }]),
                    ]}
                    onChange={onCommit}
                />
            )}
        </div>
    );
}

/* Those that the server has; asked for anew by the function. */
function useAssets(): [readonly Asset[], () => void] {
    const { rest } = useEditor();
    const [assets, setAssets] = useState<readonly Asset[]>([]);
    const [asked, setAsked] = useState(0);
    // biome-ignore lint/correctness/useExhaustiveDependencies: asks again when it is asked to
    useEffect(() => {
        let gone = false;
        rest.listAssets().then(
            (list) => gone || setAssets(list),
            () => undefined /* offline: there is nothing to choose from */,
        );
        return () => {
            gone = true;
        };
    }, [rest, asked]);
    return [assets, () => setAsked(asked + 1)];
}

function Preview({ id }: { id: string }) {
    const { rest } = useEditor();
    const [canvas, setCanvas] = useState<HTMLCanvasElement | null>(null);
    const [shown, setShown] = useState(NONE);
    useEffect(() => {
        if (id === NONE || canvas === null) {
            setShown(NONE);
            return;
        }
        const request = new AbortController();
        rest.fetchFile(rest.assetUrl(id), request.signal)
            .then((file) => thumbnail(file, canvas))
            .then(
                () => request.signal.aborted || setShown(id),
                () => undefined /* the picture that is rendered says what is wrong */,
            );
        return () => request.abort();
    }, [rest, id, canvas]);
    return (
        <div className="asset-preview">
            <canvas
                ref={setCanvas}
                hidden={shown === NONE}
                role="img"
                aria-label={t("asset.preview")}
            />
            {id === NONE && <p>{t("asset.drop")}</p>}
        </div>
    );
}
