/* SPDX-License-Identifier: MIT */
/* That this page shows some nodes alone, and the way out of it. */
import { Focus } from "lucide-react";
import { nodeLabel } from "../../model/document.ts";
import { useDocument, useEditor, useView } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import "./view.css";

export function Isolation() {
    const { stores } = useEditor();
    const isolated = useView((view) => view.isolated);
    const name = useDocument(({ document }) => {
        const node = document?.nodes.get(isolated[0] ?? "");
        return node ? nodeLabel(node) : "";
    });
    return (
        <div role="status" className="view-isolation">
            {isolated.length > 0 && (
                <div className="glass pill" data-testid="isolated">
                    <Focus size={14} aria-hidden="true" />
                    <span className="ellipsis">
                        {isolated.length === 1
                            ? t("view.isolated", { name })
                            : t("view.isolatedMore", { name, count: isolated.length - 1 })}
                    </span>
                    <Button onClick={() => stores.view.setState({ isolated: [] })}>
                        {t("view.showAll")}
                    </Button>
                </div>
            )}
        </div>
    );
}
