/* SPDX-License-Identifier: MIT */
/* What is selected, as forms. */
import { useView } from "../state.ts";
import { t } from "../texts.ts";
import { NodeInspector } from "./Node.tsx";
import { ResourceInspector } from "./Resource.tsx";
import { SetupInspector } from "./Setup.tsx";
import "./inspector.css";

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
    return (
        <>
            <div className="panel-head">
                <h2 className="panel-title">{t("region.inspector")}</h2>
            </div>
            <p className="empty-note">{t("inspector.empty")}</p>
        </>
    );
}
