/* SPDX-License-Identifier: MIT */
/* Below the tree: models, materials, lights, volumes, distance functions, shaders, each list in the
 * same way; and the camera, environment and render settings. */
import {
    Camera,
    CircleAlert,
    Eye,
    EyeOff,
    Image,
    type LucideIcon,
    Plus,
    SlidersHorizontal,
} from "lucide-react";
import { useEffect, useRef } from "react";
import { type Resource, typesOf } from "../../model/document.ts";
import {
    LIST_NAMES,
    LISTS,
    type ListName,
    type RecordName,
    resourcePlace,
    valuesPlace,
} from "../../model/places.ts";
import { problemIn } from "../../model/problems.ts";
import { findParam } from "../../model/schema.ts";
import { usersOf } from "../../model/usage.ts";
import { addResource, addTyped } from "../insertions.ts";
import { Section } from "../inspector/Section.tsx";
import { dragMaterial } from "../materials/drag.ts";
import { NewMaterial } from "../materials/NewMaterial.tsx";
import { typeTitle } from "../names.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { sentence, type TextKey, t } from "../texts.ts";
import { IconButton } from "../widgets/Button.tsx";
import { Menu, MenuItem } from "../widgets/Menu.tsx";
import { ResourceIcon, TypeIcon } from "./ResourceIcon.tsx";
import { ResourceMenu } from "./ResourceMenu.tsx";
import "../inspector/inspector.css";

export function Resources() {
    return (
        <div className="resources">
            {LIST_NAMES.map((list) => (
                <List key={list} list={list} />
            ))}
        </div>
    );
}

function List({ list }: { list: ListName }) {
    const resources = useDocument((state) => state.document?.[list]);
    return (
        <Section
            title={t(`${list}.title`)}
            count={resources?.length ?? 0}
            action={LISTS[list].id ? <AddTyped list={list} /> : <AddButton list={list} />}
        >
            {resources?.length === 0 && <p className="empty-note">{t(`${list}.empty`)}</p>}
            <ul className="resource-list">
                {resources?.map((resource) => (
                    <ResourceRow key={resource.name} list={list} resource={resource} />
                ))}
            </ul>
        </Section>
    );
}

function AddButton({ list }: { list: ListName }) {
    const editor = useEditor();
    if (list === "materials") {
        return <NewMaterial title={t("materials.add")} use={null} />;
    }
    return (
        <IconButton
            title={t(`${list}.add`)}
            data-size="s"
            onClick={() => addResource(editor, list, null)}
        >
            <Plus size={14} />
        </IconButton>
    );
}

/* Of which built-in type? */
function AddTyped({ list }: { list: ListName }) {
    const editor = useEditor();
    const types = useDocument(({ schema }) => typesOf(schema, list));
    return (
        <Menu
            align="end"
            trigger={
                <IconButton title={t(`${list}.add`)} data-size="s">
                    <Plus size={14} />
                </IconButton>
            }
        >
            {types.map(({ type }) => (
                <MenuItem
                    key={type}
                    icon={<TypeIcon list={list} type={type} />}
                    onSelect={() => addTyped(editor, list, type)}
                >
                    {typeTitle(type)}
                </MenuItem>
            ))}
        </Menu>
    );
}

function ResourceRow({ list, resource }: { list: ListName; resource: Resource }) {
    const editor = useEditor();
    const { name } = resource;
    const selected = useView(
        ({ subject }) =>
            subject.kind === "resource" && subject.list === list && subject.name === name,
    );
    const users = useDocument(({ document, schema }) =>
        document ? usersOf(schema, document, list, name).length : 0,
    );
    const problem = useDocument(({ problems }) => {
        const found = problemIn(problems, resourcePlace(list, name));
        return found && sentence(found);
    });
    const row = useRef<HTMLLIElement>(null);
    useEffect(() => {
        if (selected) {
            row.current?.scrollIntoView({ block: "nearest" });
        }
    }, [selected]);
    return (
        <li
            ref={row}
            className="resource-row"
            data-selected={selected || undefined}
            data-resource={name}
        >
            <button
                type="button"
                className="resource-pick"
                aria-pressed={selected}
                draggable={list === "materials"}
                onDragStart={list === "materials" ? dragMaterial(name) : undefined}
                onClick={() => editor.show({ kind: "resource", list, name })}
            >
                <ResourceIcon list={list} name={name} />
                <span className="ellipsis">{name}</span>
                {problem !== null && (
                    <span
                        className="tree-error"
                        role="img"
                        title={problem}
                        aria-label={t("scene.problem", { message: problem })}
                    >
                        <CircleAlert size={14} />
                    </span>
                )}
                {users > 0 && (
                    <span
                        className="resource-meta"
                        title={t("resource.users", { count: users })}
                    >{`${users}×`}</span>
                )}
            </button>
            <ResourceEye list={list} resource={resource} />
            <ResourceMenu title={t("resource.more", { name })} list={list} resource={resource} />
        </li>
    );
}

/* Switches a light off and on; for lists whose rows say that this can be. */
function ResourceEye({ list, resource }: { list: ListName; resource: Resource }) {
    const { link } = useEditor();
    const { name, type, values } = resource;
    const able = useDocument(({ schema }) => {
        const params = typesOf(schema, list).find((row) => row.type === type)?.params ?? [];
        return findParam(params, "visible") !== null;
    });
    if (!able) {
        return null;
    }
    const visible = values.visible !== false;
    const title = t(visible ? "resource.off" : "resource.on", { name });
    return (
        <button
            type="button"
            className="tree-eye"
            data-off={visible ? undefined : ""}
            aria-label={title}
            title={title}
            onClick={() =>
                link.edit(
                    [
                        {
                            op: "set",
                            at: `${valuesPlace(list, name)}/visible`,
                            value: visible ? false : null,
                        },
                    ],
                    { label: title.toLowerCase() },
                )
            }
        >
            {visible ? <Eye size={14} /> : <EyeOff size={14} />}
        </button>
    );
}

export const setups: readonly {
    kind: RecordName;
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
