/* SPDX-License-Identifier: MIT */
/* Help at hand: every type with its picture, parameters, exactness and source; searchable. */
import { Plus } from "lucide-react";
import { type RefObject, useEffect, useMemo, useRef, useState } from "react";
import { nodeType } from "../../model/schema.ts";
import { search } from "../../model/search.ts";
import { paramTitle } from "../names.ts";
import { addChosen } from "../palettes/adding.ts";
import { TypePicture } from "../palettes/TypePicture.tsx";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { Filter } from "../widgets/Filter.tsx";
import { Glyph } from "../widgets/Glyph.tsx";
import { conditionOf, defaultOf, rangeOf, type Topic, topicsOf, typeOf } from "./topics.ts";
import "./reference.css";

export function Reference({ field }: { field: RefObject<HTMLInputElement | null> }) {
    const { stores } = useEditor();
    const schema = useDocument((state) => state.schema);
    const wanted = useView((view) => view.topic);
    const [query, setQuery] = useState("");
    const all = useMemo(() => topicsOf(schema), [schema]);
    const found = useMemo(
        () =>
            search(all, query, ({ title, words, group, doc }) => ({
                name: title,
                words,
                kind: group,
                doc,
            })),
        [all, query],
    );
    const searched = query.trim() !== "";
    const topic = all.find(({ key }) => key === wanted) ?? null;
    const shown = searched && (topic === null || !found.includes(topic)) ? found[0] : topic;
    const go = (key: string | null): void => stores.view.setState({ topic: key });
    const step = (by: 1 | -1): void => {
        const now = shown ? found.indexOf(shown) : -1;
        const next = found[Math.min(found.length - 1, Math.max(0, now + by))];
        if (next) {
            go(next.key);
        }
    };
    return (
        <div className="reference-view" data-testid="reference" data-topic={shown?.key}>
            <div className="reference-list">
                <Filter
                    ref={field}
                    label={t("reference.search")}
                    value={query}
                    onChange={setQuery}
                    onKeyDown={(event) => {
                        const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
                        if (by) {
                            event.preventDefault();
                            step(by as 1 | -1);
                        }
                    }}
                />
                <Index topics={found} shown={shown ?? null} onGo={go} />
            </div>
            {shown ? <Page key={shown.key} topic={shown} /> : <Welcome count={found.length} />}
        </div>
    );
}

interface IndexProps {
    topics: readonly Topic[];
    shown: Topic | null;
    onGo: (key: string) => void;
}

function Index({ topics, shown, onGo }: IndexProps) {
    const groups = [...new Set(topics.map(({ group }) => group))];
    const schema = useDocument((state) => state.schema);
    const list = useRef<HTMLElement>(null);
    const key = shown?.key;
    // biome-ignore lint/correctness/useExhaustiveDependencies: what is shown is brought in sight
    useEffect(() => {
        list.current?.querySelector("[aria-current]")?.scrollIntoView({ block: "center" });
    }, [key]);
    return (
        <nav ref={list} className="reference-index" aria-label={t("reference.index")}>
            {groups.map((group) => (
                <section key={group} aria-label={group}>
                    <h3>{group}</h3>
                    {topics
                        .filter((topic) => topic.group === group)
                        .map((topic) => (
                            <button
                                key={topic.key}
                                type="button"
                                className="reference-link"
                                aria-current={topic === shown ? "true" : undefined}
                                onClick={() => onGo(topic.key)}
                            >
                                {topic.node && (
                                    <Glyph
                                        type={topic.key}
                                        group={nodeType(schema, topic.key)?.group}
                                    />
                                )}
                                <span className="ellipsis">{topic.title}</span>
                            </button>
                        ))}
                </section>
            ))}
            {topics.length === 0 && <p className="empty-note">{t("reference.empty")}</p>}
        </nav>
    );
}

function Welcome({ count }: { count: number }) {
    return <p className="reference-page empty-note">{t("reference.welcome", { count })}</p>;
}

function Page({ topic }: { topic: Topic }) {
    const editor = useEditor();
    const open = useDocument((state) => state.document !== null);
    const group = useDocument((state) => nodeType(state.schema, topic.key)?.group);
    const { title, doc, exactness, params, source, words, node } = topic;
    const add = (): void => {
        editor.stores.view.setState({ popup: null });
        addChosen(editor, { type: topic.key });
    };
    return (
        // biome-ignore lint/a11y/noNoninteractiveTabindex: it scrolls, so keys must reach it
        <article className="reference-page" tabIndex={0} aria-label={title}>
            <header>
                {node && (
                    <div className="reference-picture">
                        <TypePicture type={topic.key} group={group} size={72} />
                    </div>
                )}
                <div>
                    <h3>{title}</h3>
                    <p>{doc}</p>
                    {exactness && (
                        <p
                            className="reference-exact"
                            data-exact={exactness === "exact" || undefined}
                        >
                            <b>
                                {t(exactness === "exact" ? "inspector.exact" : "inspector.bound")}
                            </b>{" "}
                            {t(exactness === "exact" ? "reference.exact" : "reference.bound")}
                        </p>
                    )}
                    {node && open && (
                        <Button look="outline" icon={<Plus size={14} />} onClick={add}>
                            {t("reference.add")}
                        </Button>
                    )}
                </div>
            </header>
            {params.length === 0 ? (
                <p className="empty-note">{t("reference.noParams")}</p>
            ) : (
                <div className="reference-params">
                    {params.map((param) => (
                        <section key={param.name}>
                            <h4>
                                {paramTitle(param)}
                                <code>{param.name}</code>
                            </h4>
                            <p>{param.doc}</p>
                            <dl>
                                <Fact name={t("reference.type")} value={typeOf(param)} />
                                <Fact name={t("rows.default")} value={defaultOf(param)} />
                                <Fact name={t("rows.range")} value={rangeOf(param)} />
                                <Fact name={t("reference.when")} value={conditionOf(param)} />
                            </dl>
                        </section>
                    ))}
                </div>
            )}
            {(source || words) && (
                <footer>
                    {words && <p>{t("reference.words", { words: words.replaceAll(" ", ", ") })}</p>}
                    {source && <p>{t("reference.source", { source })}</p>}
                </footer>
            )}
        </article>
    );
}

function Fact({ name, value }: { name: string; value: string }) {
    return value === "" ? null : (
        <div>
            <dt>{name}</dt>
            <dd>{value}</dd>
        </div>
    );
}
