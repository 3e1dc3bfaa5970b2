/* SPDX-License-Identifier: MIT */
/* The start page: own scenes, examples, a new scene, files dropped anywhere. */
import { CircleHelp, FolderUp, Plus, Upload } from "lucide-react";
import { useCallback, useEffect, useRef, useState } from "react";
import type { ExampleEntry, SceneEntry } from "../../link/rest.ts";
import { search } from "../../model/search.ts";
import { useDrop } from "../drop/drop.ts";
import { chooseFiles, type PageFile, report, SCENE_FILES } from "../files.ts";
import { type ImportProblem, openFiles, readFiles } from "../import.ts";
import { ThemeButton } from "../layout/Bar.tsx";
import { goTo } from "../route.ts";
import { useEditor } from "../state.ts";
import { type TextKey, t } from "../texts.ts";
import { Button, IconButton } from "../widgets/Button.tsx";
import { Filter } from "../widgets/Filter.tsx";
import { Logo } from "../widgets/Logo.tsx";
import { ExampleCard, Leaving, SceneCard } from "./Card.tsx";
import ImportFault from "./ImportFault.tsx";
import "./scenes.css";

/* What a new scene starts with. No shapes yet, but the first one will stand in the light. */
const EMPTY_SCENE = {
    format: "fieldcast/1",
    name: t("bar.untitled"),
    camera: { position: [1.8, 1.3, 3], fov: 35 },
    lights: [{ id: "sun", type: "directional", intensity: 3 }],
    root: { id: "root", type: "union", children: [] },
};

interface Lists {
    scenes: readonly SceneEntry[] | null;
    examples: readonly ExampleEntry[];
    failed: string | null;
    reload: () => void;
}

function useLists(): Lists {
    const { rest } = useEditor();
    const [scenes, setScenes] = useState<readonly SceneEntry[] | null>(null);
    const [examples, setExamples] = useState<readonly ExampleEntry[]>([]);
    const [failed, setFailed] = useState<string | null>(null);
    const reload = useCallback(() => {
        rest.listScenes().then(
            (list) => {
                setScenes([...list].sort(newestFirst));
                setFailed(null);
            },
            (error: Error) => setFailed(error.message),
        );
    }, [rest]);
    useEffect(() => {
        reload();
        rest.listExamples().then(setExamples, () => undefined /* told by the other request */);
    }, [rest, reload]);
    return { scenes, examples, failed, reload };
}

/* Scenes that are shown as deleted and can still be taken back. Leaving the page deletes them. */
function useLeaving(reload: () => void) {
    const editor = useEditor();
    const [leaving, setLeaving] = useState<readonly SceneEntry[]>([]);
    const now = useRef(leaving);
    now.current = leaving;
    const stay = (id: string): void => setLeaving((old) => old.filter((scene) => scene.id !== id));
    const remove = (id: string): void => {
        editor.rest
            .deleteScene(id)
            .catch((error: unknown) => report(editor, error))
            .finally(() => {
                reload();
                stay(id);
            });
    };
    useEffect(
        () => () => {
            for (const { id } of now.current) {
                void editor.rest.deleteScene(id).catch(() => undefined);
            }
        },
        [editor],
    );
    return {
        leaving,
        leave: (scene: SceneEntry): void => setLeaving((old) => [...old, scene]),
        stay,
        remove,
    };
}

function newestFirst(a: SceneEntry, b: SceneEntry): number {
    return timeOf(b) - timeOf(a);
}

/* Milliseconds; a number of the server counts seconds. */
export function timeOf({ modified }: SceneEntry): number {
    const time = typeof modified === "number" ? modified * 1000 : Date.parse(modified);
    return Number.isFinite(time) ? time : 0;
}

export default function ScenesPage() {
    const editor = useEditor();
    const { scenes, examples, failed, reload } = useLists();
    const { leaving, leave, stay, remove } = useLeaving(reload);
    const [problem, setProblem] = useState<ImportProblem | null>(null);
    const take = (files: readonly PageFile[]): void =>
        void readFiles(editor, files).then((texts) => openFiles(editor, texts, setProblem));
    const dropping = useDrop(take);
    const choose = (folder: boolean) => (): void =>
        chooseFiles(folder ? "folder" : SCENE_FILES, take);
    const start = async (make: () => Promise<string>): Promise<void> => {
        try {
            goTo(await make());
        } catch (error) {
            report(editor, error);
        }
    };
    const [query, setQuery] = useState("");
    const staying = scenes?.filter((scene) => !leaving.some(({ id }) => id === scene.id)) ?? [];
    return (
        <div className="scenes">
            <Head
                onNew={() => void start(() => editor.rest.createScene(EMPTY_SCENE))}
                onFiles={choose(false)}
                onFolder={choose(true)}
            />
            <main className="scenes-body" data-region={t("scenes.title")} tabIndex={-1}>
                {failed !== null && (
                    <p className="page-note" role="alert">
                        {t("scenes.failed", { message: failed })}
                        <Button look="outline" onClick={reload}>
                            {t("link.retry")}
                        </Button>
                    </p>
                )}
                <div className="scenes-head">
                    <h2>{t("scenes.title")}</h2>
                    {scenes?.length === 0 && <p>{t("scenes.none")}</p>}
                    <span className="bar-space" />
                    <Filter
                        className="scenes-search"
                        label={t("scenes.search")}
                        value={query}
                        onChange={setQuery}
                    />
                </div>
                <Own scenes={staying} query={query} onChange={reload} onLeave={leave} />
                <Examples
                    examples={examples}
                    query={query}
                    onOpen={(id) => void start(() => editor.rest.createFromExample(id))}
                />
            </main>
            <div className="leaving-list">
                {leaving.map((scene) => (
                    <Leaving
                        key={scene.id}
                        name={scene.name || scene.id}
                        onUndo={() => stay(scene.id)}
                        onGone={() => remove(scene.id)}
                    />
                ))}
            </div>
            <ImportFault
                problem={problem}
                onChoose={(scene) => {
                    setProblem(null);
                    void openFiles(editor, problem?.files ?? [], setProblem, scene);
                }}
                onClose={() => setProblem(null)}
            />
            {dropping && <div className="drop-cover">{t("scenes.drop")}</div>}
        </div>
    );
}

const MINUTE_MS = 60_000;

/* The time, to a minute. */
function useNow(): number {
    const [now, setNow] = useState(Date.now);
    useEffect(() => {
        const timer = setInterval(() => setNow(Date.now()), MINUTE_MS);
        return () => clearInterval(timer);
    }, []);
    return now;
}

/* So many of the newest are shown at first. */
const RECENT = 8;

interface OwnProps {
    scenes: readonly SceneEntry[];
    query: string;
    onChange: () => void;
    onLeave: (scene: SceneEntry) => void;
}

/* The newest, or all that fits a search. */
function Own({ scenes, query, onChange, onLeave }: OwnProps) {
    const [all, setAll] = useState(false);
    const now = useNow();
    const found = search(scenes, query, ({ name, id }) => ({ name: name || id, words: id }));
    const shown = all || query.trim() !== "" ? found : found.slice(0, RECENT);
    return (
        <>
            <ul className="cards" data-testid="scenes">
                {shown.map((scene) => (
                    <SceneCard
                        key={scene.id}
                        scene={scene}
                        now={now}
                        onChange={onChange}
                        onLeave={() => onLeave(scene)}
                    />
                ))}
            </ul>
            {scenes.length > 0 && found.length === 0 && (
                <p className="empty-note">{t("palette.nothing", { query })}</p>
            )}
            {shown.length < found.length && (
                <Button look="outline" className="scenes-all" onClick={() => setAll(true)}>
                    {t("scenes.all", { count: found.length })}
                </Button>
            )}
        </>
    );
}

interface ExamplesProps {
    examples: readonly ExampleEntry[];
    query: string;
    onOpen: (id: string) => void;
}

/* In the server's groups, and what of them fits a search. */
function Examples({ examples, query, onOpen }: ExamplesProps) {
    const groups = [...new Set(examples.map(({ group }) => group))];
    const titleOf = (group: string): string => t(`examples.${group}` as TextKey);
    const found = search(examples, query, ({ name, id, group, description }) => ({
        name,
        words: id.replaceAll("-", " "),
        kind: titleOf(group),
        doc: description,
    }));
    return (
        <div data-testid="examples">
            <div className="scenes-head">
                <h2>{t("scenes.examples")}</h2>
                <p>{t("scenes.examplesDoc")}</p>
            </div>
            {groups.map((group) => {
                const own = found.filter((example) => example.group === group);
                return (
                    own.length > 0 && (
                        <section key={group} aria-label={titleOf(group)}>
                            <h3 className="scenes-group">{titleOf(group)}</h3>
                            <ul className="cards" data-group={group}>
                                {own.map((example) => (
                                    <ExampleCard
                                        key={example.id}
                                        example={example}
                                        onOpen={() => onOpen(example.id)}
                                    />
                                ))}
                            </ul>
                        </section>
                    )
                );
            })}
            {examples.length > 0 && found.length === 0 && (
                <p className="empty-note">{t("palette.nothing", { query })}</p>
            )}
        </div>
    );
}

interface HeadProps {
    onNew: () => void;
    onFiles: () => void;
    onFolder: () => void;
}

function Head({ onNew, onFiles, onFolder }: HeadProps) {
    const editor = useEditor();
    return (
        <header className="scenes-bar" data-region={t("region.bar")} tabIndex={-1}>
            <div>
                <h1 className="brand">
                    <Logo size={26} />
                    {t("app.name")}
                </h1>
                <span className="brand-line">{t("scenes.tagline")}</span>
                <span className="bar-space" />
                <ThemeButton />
                <IconButton
                    title={t("bar.help")}
                    keys="?"
                    onClick={() => editor.stores.view.setState({ popup: "help" })}
                >
                    <CircleHelp size={16} />
                </IconButton>
                <Button
                    look="outline"
                    aria-label={t("scenes.upload")}
                    icon={<Upload size={14} aria-hidden="true" />}
                    onClick={onFiles}
                >
                    <span className="wide-only">{t("scenes.upload")}</span>
                </Button>
                <IconButton className="wide-only" title={t("scenes.folder")} onClick={onFolder}>
                    <FolderUp size={16} />
                </IconButton>
                <Button look="primary" icon={<Plus size={15} aria-hidden="true" />} onClick={onNew}>
                    {t("scenes.new")}
                </Button>
            </div>
        </header>
    );
}
