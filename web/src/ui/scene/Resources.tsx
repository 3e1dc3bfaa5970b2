/* SPDX-License-Identifier: MIT */
/* Below the tree: materials, lights, and the camera, environment and render settings. */
import {
    Camera,
    Copy,
    Ellipsis,
    Image,
    Lightbulb,
    type LucideIcon,
    Plus,
    SlidersHorizontal,
    Sun,
    Trash2,
} from "lucide-react";
import { type ListName, materialUsers, type Resource } from "../../model/document.ts";
import { addLight, addMaterial, duplicateResource, removeResource } from "../acts.ts";
import { Section } from "../inspector/Section.tsx";
import { typeTitle } from "../names.ts";
import { IconButton } from "../parts/Button.tsx";
import { Menu, MenuItem } from "../parts/Menu.tsx";
import { Swatch } from "../parts/Swatch.tsx";
import { useDocument, useEditor, useView } from "../state.ts";
import { type TextKey, t } from "../texts.ts";
import "../inspector/inspector.css";

export function Resources() {
    return (
        <div className="resources">
            <Materials />
            <Lights />
        </div>
    );
}

function Materials() {
    const editor = useEditor();
    const materials = useDocument((state) => state.document?.materials);
    return (
        <Section
            title={t("materials.title")}
            count={materials?.length ?? 0}
            action={
                <IconButton
                    title={t("materials.add")}
                    data-size="s"
                    onClick={() => addMaterial(editor, null)}
                >
                    <Plus size={14} />
                </IconButton>
            }
        >
            {materials?.length === 0 && <p className="empty-note">{t("materials.empty")}</p>}
            <ul className="resource-list">
                {materials?.map((material) => (
                    <ResourceRow key={material.name} list="materials" resource={material} />
                ))}
            </ul>
        </Section>
    );
}

function Lights() {
    const editor = useEditor();
    const lights = useDocument((state) => state.document?.lights);
    const types = useDocument((state) => state.schema.lights);
    return (
        <Section
            title={t("lights.title")}
            count={lights?.length ?? 0}
            action={
                <Menu
                    align="end"
                    trigger={
                        <IconButton title={t("lights.add")} data-size="s">
                            <Plus size={14} />
                        </IconButton>
                    }
                >
                    {types.map(({ type }) => (
                        <MenuItem
                            key={type}
                            icon={<LightIcon type={type} />}
                            onSelect={() => addLight(editor, type)}
                        >
                            {typeTitle(type)}
                        </MenuItem>
                    ))}
                </Menu>
            }
        >
            {lights?.length === 0 && <p className="empty-note">{t("lights.empty")}</p>}
            <ul className="resource-list">
                {lights?.map((light) => (
                    <ResourceRow key={light.name} list="lights" resource={light} />
                ))}
            </ul>
        </Section>
    );
}

export function LightIcon({ type, size = 15 }: { type: string; size?: number }) {
    const Icon = type === "directional" ? Sun : Lightbulb;
    return <Icon size={size} aria-hidden="true" />;
}

function ResourceRow({ list, resource }: { list: ListName; resource: Resource }) {
    const editor = useEditor();
    const { name } = resource;
    const kind = list === "lights" ? "light" : "material";
    const selected = useView(
        ({ subject }) => subject.kind === kind && "name" in subject && subject.name === name,
    );
    const users = useDocument((state) =>
        state.document && list === "materials" ? materialUsers(state.document, name).length : 0,
    );
    return (
        <li className="resource-row" data-selected={selected || undefined} data-resource={name}>
            <button
                type="button"
                className="resource-pick"
                aria-pressed={selected}
                onClick={() => editor.show({ kind, name })}
            >
                {list === "lights" ? <LightIcon type={resource.type} /> : <Swatch name={name} />}
                <span className="ellipsis">{name}</span>
                {users > 0 && <span className="resource-meta">{users}×</span>}
            </button>
            <Menu
                align="end"
                trigger={
                    <IconButton title={t("resource.more", { name })} data-size="s">
                        <Ellipsis size={14} />
                    </IconButton>
                }
            >
                <MenuItem
                    icon={<Copy size={14} />}
                    onSelect={() => duplicateResource(editor, list, resource)}
                >
                    {t("resource.duplicate")}
                </MenuItem>
                <MenuItem
                    icon={<Trash2 size={14} />}
                    danger
                    onSelect={() => removeResource(editor, list, name)}
                >
                    {t("resource.remove")}
                </MenuItem>
            </Menu>
        </li>
    );
}

export const setups: readonly {
    kind: "camera" | "environment" | "render";
    title: TextKey;
    icon: LucideIcon;
}[] = [
    { kind: "camera", title: "setup.camera", icon: Camera },
    { kind: "environment", title: "setup.environment", icon: Image },
    { kind: "render", title: "setup.render", icon: SlidersHorizontal },
];

/* Always in sight below the lists. */
export function Setup() {
    const editor = useEditor();
    const shown = useView(({ subject }) => subject.kind);
    return (
        <nav className="setup" aria-label={t("setup.title")}>
            {setups.map(({ kind, title, icon: Icon }) => (
                <button
                    key={kind}
                    type="button"
                    className="setup-button"
                    aria-pressed={shown === kind}
                    onClick={() => editor.show({ kind })}
                >
                    <Icon size={15} aria-hidden="true" />
                    <span className="ellipsis">{t(title)}</span>
                </button>
            ))}
        </nav>
    );
}
