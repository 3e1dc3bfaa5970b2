/* SPDX-License-Identifier: MIT */
/* A badge: how well an equation is drawn. The server judges it anew after each edit of the node, once
 * it has the edit; until then the badge says what was, dimmed. */
import { CircleAlert, CircleCheck, TriangleAlert } from "lucide-react";
import { useEffect, useState } from "react";
import { type Quality, qualityOf } from "../../link/qualityRest.ts";
import { RestError } from "../../link/rest.ts";
import { paramAt } from "../../model/document.ts";
import { useDocument, useEditor } from "../state.ts";
import { Tip } from "../widgets/Tip.tsx";
import { qualityTexts } from "./qualityTexts.ts";
import "./quality.css";

/* A pause in changes after which the server is asked, and one after which a busy server is asked
 * again. */
const ASK_MS = 300;
const AGAIN_MS = 3000;

const isBusy = (problem: unknown): boolean =>
    problem instanceof RestError && (problem.status === 429 || problem.status === 503);

interface Judged {
    readonly node: string;
    readonly quality: Quality | null;
    /* What was judged. */
    readonly key: string;
}

/* null: it is not known. `key`: what it is judged by. */
function useQuality(node: string, place: string): { judged: Judged | null; key: string } {
    const { rest } = useEditor();
    const scene = useDocument((state) => state.scene);
    const sent = useDocument((state) => state.waiting === 0);
    const key = useDocument(({ schema, document }) => {
        const { parametric: _, ...values } =
            (document && paramAt(schema, document, place)?.values) ?? {};
        return JSON.stringify(values);
    });
    const [judged, setJudged] = useState<Judged | null>(null);
    useEffect(() => {
        if (scene === null || !sent) {
            return;
        }
        const request = new AbortController();
        let timer: ReturnType<typeof setTimeout>;
        const tell = (quality: Quality | null): void => {
            if (!request.signal.aborted) {
                setJudged({ node, quality, key });
            }
        };
        const askIn = (ms: number): void => {
            timer = setTimeout(() => {
                qualityOf(rest, scene, node, request.signal).then(tell, (problem) => {
                    tell(null);
                    if (isBusy(problem) && !request.signal.aborted) {
                        askIn(AGAIN_MS);
                    }
                });
            }, ms);
        };
        askIn(ASK_MS);
        return () => {
            clearTimeout(timer);
            request.abort();
        };
    }, [rest, scene, node, sent, key]);
    return { judged: judged?.node === node ? judged : null, key };
}

export default function QualityBadge({ node, place }: { node: string; place: string }) {
    const { judged, key } = useQuality(node, place);
    const quality = judged?.quality ?? null;
    if (quality === null) {
        return null;
    }
    const { words, doc, note } = qualityTexts(quality);
    const unsafe = quality.quality === "unsafe" || quality.thin;
    const open = quality.unresolved > 0 || quality.leftOut > 0;
    const state = unsafe ? "unsafe" : open ? "unresolved" : "good";
    const Icon = { unsafe: TriangleAlert, unresolved: CircleAlert, good: CircleCheck }[state];
    return (
        <div role="status">
            <Tip text={doc} note={note}>
                <button
                    type="button"
                    className="quality-badge"
                    data-quality={state}
                    data-old={judged?.key !== key || undefined}
                >
                    <Icon size={14} aria-hidden="true" />
                    <span>{words}</span>
                </button>
            </Tip>
        </div>
    );
}
