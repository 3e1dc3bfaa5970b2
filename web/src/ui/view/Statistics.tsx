/* SPDX-License-Identifier: MIT */
/* Frames per second and milliseconds in a pill; a press shows where the time goes. */
import { Gauge } from "lucide-react";
import type { Schema } from "../../model/schema.ts";
import type { LinkState, Statistics as Numbers } from "../../model/stores.ts";
import { drawnBy, words } from "../names.ts";
import { useDocument, useEditor, useLink, useView } from "../state.ts";
import { type TextKey, t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import { Popover } from "../widgets/Popover.tsx";
import { frameTime, rateText } from "./rate.ts";
import "./view.css";

/* Where the time of a frame goes, in milliseconds. */
interface Stage {
    title: string;
    doc: string;
    time: number;
}

/* Neighbours differ in colour and in lightness. */
const COLOURS: readonly string[] = [
    "#8f8f8f",
    "#c3a2f2",
    "#2f9c95",
    "#8be0d9",
    "#b4662a",
    "#f0b97e",
    "#c94f45",
    "#ff9f96",
    "#4b7fd6",
    "#a9c8ff",
    "#4f9a45",
    "#a3dd98",
    "#6b6b6b",
    "#d0d0d0",
];
const colourOf = (i: number): string => COLOURS[i % COLOURS.length] ?? "";

/* The server's stages, then what happens here. */
function stagesOf(schema: Schema, numbers: Numbers): readonly Stage[] {
    const here = (key: "net" | "decode" | "present", time: number): Stage => ({
        title: t(`stats.${key}`),
        doc: t(`stats.${key}Doc`),
        time,
    });
    return [
        ...schema.stages.map(({ name, doc }, i) => ({
            title: words(name),
            doc,
            time: numbers.stages[i] ?? 0,
        })),
        here("net", numbers.receive),
        here("decode", numbers.decode),
        here("present", numbers.present),
    ];
}

/* Milliseconds; less is written 0.0. */
const LEAST_SHOWN = 0.05;

const round = (x: number): string => (x >= 10 ? x.toFixed(0) : x.toFixed(1));

export default function StatisticsPill() {
    const { stores } = useEditor();
    const text = useLink(rateText);
    const open = useView((view) => view.popup === "statistics");
    return (
        <Popover
            label={t("stats.open")}
            side="top"
            open={open}
            onOpenChange={(now) => stores.view.setState({ popup: now ? "statistics" : null })}
            trigger={
                <button
                    type="button"
                    className="glass pill"
                    data-testid="statistics"
                    aria-label={`${t("stats.open")}: ${text}`}
                >
                    <Gauge size={14} aria-hidden="true" />
                    {text}
                </button>
            }
        >
            <Sheet />
        </Popover>
    );
}

function Sheet() {
    const link = useLink((state) => state);
    const schema = useDocument((state) => state.schema);
    const numbers = link.statistics;
    if (numbers === null) {
        return <p className="stats">{t("stats.none")}</p>;
    }
    const stages = stagesOf(schema, numbers);
    const sum = Math.max(0.001, frameTime(numbers));
    return (
        // biome-ignore lint/a11y/noNoninteractiveTabindex: it may scroll, and is read from its top
        <div className="stats" tabIndex={0}>
            <div className="stats-title">
                <span>
                    {t(numbers.state === "none" ? "stats.title" : `stats.${numbers.state}`)}
                </span>
                <span>{round(sum)} ms</span>
            </div>
            <div className="stats-bar" aria-hidden="true">
                {stages.map(
                    ({ title, time }, i) =>
                        time >= LEAST_SHOWN && (
                            <span
                                key={title}
                                style={{ background: colourOf(i), flexGrow: time / sum }}
                            />
                        ),
                )}
            </div>
            <dl className="stats-table">
                {stages.map(({ title, doc, time }, i) => (
                    <div key={title} className="stats-row" title={doc}>
                        <dt>
                            <span className="stats-key" style={{ background: colourOf(i) }} />
                            {title}
                        </dt>
                        <dd data-none={time < LEAST_SHOWN || undefined}>{round(time)} ms</dd>
                    </div>
                ))}
            </dl>
            <dl className="stats-table stats-facts">
                {facts(link, numbers).map(([title, value]) => (
                    <div key={title} className="stats-row">
                        <dt>{t(title)}</dt>
                        <dd>{value}</dd>
                    </div>
                ))}
            </dl>
            <Copy link={link} />
        </div>
    );
}

function facts(link: LinkState, numbers: Numbers): (readonly [TextKey, string])[] {
    const { frame, renderer } = link;
    const photon =
        numbers.photonP50 === null
            ? "–"
            : `${round(numbers.photonP50)} / ${round(numbers.photonP95 ?? numbers.photonP50)} ms`;
    return [
        ["stats.photon", photon],
        ["stats.bytes", `${(numbers.bytesPerFrame / 1024).toFixed(1)} KiB`],
        ["stats.size", `${frame.width} × ${frame.height}`],
        ["stats.revision", String(frame.revision)],
        ["stats.dropped", String(numbers.dropped)],
        ["stats.renderer", renderer === null ? "–" : drawnBy(renderer)],
    ];
}

function Copy({ link }: { link: LinkState }) {
    const editor = useEditor();
    const { statistics, frame, renderer } = link;
    return (
        <Button
            look="outline"
            onClick={() =>
                editor.writeClipboard(JSON.stringify({ statistics, frame, renderer }, null, 2))
            }
        >
            {t("stats.copy")}
        </Button>
    );
}
