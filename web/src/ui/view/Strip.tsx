/* SPDX-License-Identifier: MIT */
/* The state of the connection when there is something to say: the last picture stays, edits are
 * kept and sent later. */
import { CloudOff } from "lucide-react";
import { isGone } from "../../model/stores.ts";
import { goTo } from "../route.ts";
import { useDocument, useEditor, useLink } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import "./view.css";

const reasonText = (reason: string): string =>
    reason === "replaced" ? t("link.replaced") : t("link.refused", { reason });

export function Strip() {
    const editor = useEditor();
    const connection = useLink((state) => state.connection);
    const reason = useLink((state) => state.reason);
    const waiting = useDocument((state) => state.waiting);
    const gone = useLink(isGone);
    const text = gone
        ? t("link.gone")
        : connection === "refused"
          ? reasonText(reason)
          : waiting > 0
            ? t("link.offlineWaiting", { count: waiting })
            : t("link.offline");
    const shown = connection === "offline" || connection === "refused";
    return (
        <div role="status" className="strip-place">
            {shown && (
                <div className="strip" data-testid="strip">
                    <CloudOff size={15} aria-hidden="true" />
                    <span>{text}</span>
                    {gone ? (
                        <Button look="outline" onClick={() => goTo(null)}>
                            {t("bar.scenes")}
                        </Button>
                    ) : (
                        <Button look="outline" onClick={() => editor.retry()}>
                            {t("link.retry")}
                        </Button>
                    )}
                </div>
            )}
        </div>
    );
}
