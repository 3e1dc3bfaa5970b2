/* SPDX-License-Identifier: MIT */
/* Frames per second and milliseconds in a pill; a press shows where the time goes. */
import { Gauge } from "lucide-react";
import type { LinkState, Statistics as Numbers } from "../../model/stores.ts";
import { Button } from "../parts/Button.tsx";
import { Popover } from "../parts/Popover.tsx";
import { useEditor, useLink, useView } from "../state.ts";
import { type TextKey, t } from "../texts.ts";
import "./view.css";

interface Stage {
    title: TextKey;
    colour: string;
    of: (numbers: Numbers) => number;
}

const stages: readonly Stage[] = [
    { title: "stats.queue", colour: "#8f8f8f", of: (n) => n.queue },
    { title: "stats.march", colour: "#5cc8c2", of: (n) => n.march },
    { title: "stats.light", colour: "#f0a868", of: (n) => n.light },
    { title: "stats.read", colour: "#c3a2f2", of: (n) => n.read },
    { title: "stats.encode", colour: "#86b4ff", of: (n) => n.encode },
    { title: "stats.net", colour: "#8bd280", of: (n) => n.receive },
    { title: "stats.decode", colour: "#ff8f85", of: (n) => n.decode + n.present },
];

function total(numbers: Numbers): number {
    return stages.reduce((sum, stage) => sum + stage.of(numbers), 0);
}

const round = (x: number): string => (x >= 10 ? x.toFixed(0) : x.toFixed(1));

function summary(numbers: Numbers | null): string {
    if (numbers === null || numbers.fps < 0.5) {
        return t("stats.idle");
    }
    const ms = numbers.photonP50 ?? total(numbers);
    return t("stats.fps", { fps: Math.round(numbers.fps), ms: Math.round(ms) });
}

export default function StatisticsPill() {
    const { stores } = useEditor();
    const text = useLink((state) => summary(state.statistics));
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
    const numbers = link.statistics;
    if (numbers === null) {
        return <p className="stats">{t("stats.none")}</p>;
    }
    const sum = Math.max(0.001, total(numbers));
    return (
        <div className="stats">
            <div className="stats-title">
                <span>{t("stats.title")}</span>
                <span>{round(sum)} ms</span>
            </div>
            <div className="stats-bar" aria-hidden="true">
                {stages.map(({ title, colour, of }) => (
                    <span
                        key={title}
                        style={{ background: colour, flexGrow: Math.max(0, of(numbers)) / sum }}
                    />
                ))}
            </div>
            <dl className="stats-table">
                {stages.map(({ title, colour, of }) => (
                    <div key={title} className="stats-row">
                        <dt>
                            <span className="stats-key" style={{ background: colour }} />
                            {t(title)}
                        </dt>
                        <dd>{round(of(numbers))} ms</dd>
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
        ["stats.renderer", renderer?.name ?? "–"],
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
