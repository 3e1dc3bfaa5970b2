/* SPDX-License-Identifier: MIT */
/* Which output is shown, and how sharp while moving. What is not the picture itself is marked, with
 * the way back beside it. */
import { Layers2, X } from "lucide-react";
import { outputsShown } from "../../model/schema.ts";
import { setPreferences } from "../../model/stores.ts";
import { COLOR, QUALITIES } from "../../model/view.ts";
import { useKeyText } from "../layout/keys.ts";
import { lazyPart } from "../lazy.tsx";
import { outputTitle } from "../names.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Menu, MenuItem, MenuLine } from "../widgets/Menu.tsx";
import { Tip } from "../widgets/Tip.tsx";
import "./view.css";

const Probe = lazyPart(() => import("./Probe.tsx"));

export function Outputs() {
    const aov = useView((view) => view.aov);
    const name = outputTitle(aov);
    return (
        <div className="outputs-place">
            <Shown aov={aov} name={name} />
            <Legend aov={aov} />
            <Probe />
        </div>
    );
}

function Shown({ aov, name }: { aov: string; name: string }) {
    return (
        <div className="glass outputs" data-other={aov !== COLOR || undefined}>
            <Menu
                align="end"
                trigger={
                    <button
                        type="button"
                        className="pill"
                        data-testid="outputs"
                        aria-label={t("output.menu", { name })}
                    >
                        <Layers2 size={14} aria-hidden="true" />
                        <span className="outputs-name">{name}</span>
                    </button>
                }
            >
                <Choices />
            </Menu>
            {aov !== COLOR && <Back />}
        </div>
    );
}

/* What the colours of an output stand for, where it has a scale. */
function Legend({ aov }: { aov: string }) {
    const schema = useDocument((state) => state.schema);
    const scale = schema.outputs.find(({ name }) => name === aov)?.scale ?? null;
    if (scale === null) {
        return null;
    }
    const count = scale.greatest;
    return (
        <div
            className="glass outputs-legend"
            data-testid="legend"
            role="img"
            aria-label={t("output.legend", { count })}
        >
            <span>0</span>
            <span
                className="outputs-ramp"
                style={{ background: `linear-gradient(to right, ${scale.colors.join(", ")})` }}
            />
            <span>{t("output.more", { count })}</span>
        </div>
    );
}

function Back() {
    const { stores } = useEditor();
    return (
        <Tip text={t("output.back")} keys={useKeyText("view.color")}>
            <button
                type="button"
                className="pill outputs-back"
                aria-label={t("output.back")}
                onClick={() => stores.view.setState({ aov: COLOR })}
            >
                <X size={14} aria-hidden="true" />
            </button>
        </Tip>
    );
}

function Choices() {
    const { stores } = useEditor();
    const schema = useDocument((state) => state.schema);
    const aov = useView((view) => view.aov);
    const quality = useView((view) => view.preferences.quality);
    const probe = useView((view) => view.preferences.probe);
    return (
        <>
            {outputsShown(schema).map(({ name, doc }) => (
                <MenuItem
                    key={name}
                    checked={name === aov}
                    doc={doc}
                    onSelect={() => stores.view.setState({ aov: name })}
                >
                    {outputTitle(name)}
                </MenuItem>
            ))}
            <MenuLine />
            <MenuItem
                checked={probe}
                onSelect={() => setPreferences(stores.view, { probe: !probe })}
            >
                {t("probe.title")}
            </MenuItem>
            <MenuLine />
            {QUALITIES.map((one) => (
                <MenuItem
                    key={one}
                    checked={one === quality}
                    onSelect={() => setPreferences(stores.view, { quality: one })}
                >
                    {t(`quality.${one}`)}
                </MenuItem>
            ))}
        </>
    );
}
