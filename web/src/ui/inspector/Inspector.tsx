/* SPDX-License-Identifier: MIT */
/* What is selected, as forms. */
import { lazyPart } from "../lazy.tsx";
import { useView } from "../state.ts";
import { t } from "../texts.ts";
import { TOUCH, useMedia } from "../theme.ts";
import "./inspector.css";

const NodeInspector = lazyPart(() => import("./Node.tsx"));
const ResourceInspector = lazyPart(() => import("./Resource.tsx"));
const SetupInspector = lazyPart(() => import("./Setup.tsx"));

export function Inspector() {
    const subject = useView((view) => view.subject);
    const active = useView((view) => view.selection.at(-1) ?? null);
    switch (subject.kind) {
        case "resource": {
            const { list, name } = subject;
            return <ResourceInspector key={`${list}/${name}`} list={list} name={name} />;
        }
        case "camera":
        case "environment":
        case "render":
            return <SetupInspector kind={subject.kind} />;
        default:
            return active === null ? <Nothing /> : <NodeInspector key={active} id={active} />;
    }
}

export function Nothing() {
    const touch = useMedia(TOUCH);
    return (
        <>
            <div className="panel-head">
                <h2 className="panel-title">{t("region.inspector")}</h2>
            </div>
            <p className="empty-note">{t(touch ? "inspector.emptyTouch" : "inspector.empty")}</p>
        </>
    );
}
