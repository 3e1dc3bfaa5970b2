/* SPDX-License-Identifier: MIT */
/* Whether what was done here is durable on the server. */
import { Check, CloudUpload } from "lucide-react";
import { useDocument } from "../state.ts";
import { t } from "../texts.ts";
import "./layout.css";

export function Saved({ compact }: { compact?: boolean }) {
    const saved = useDocument((state) => state.saved);
    const waiting = useDocument((state) => state.waiting);
    const revision = useDocument((state) => state.revision);
    const open = useDocument((state) => state.document !== null);
    if (!open) {
        return null;
    }
    const words = saved
        ? t("saved.saved", { revision })
        : waiting > 0
          ? t("saved.waiting", { count: waiting })
          : t("saved.saving");
    return (
        <span
            className="saved"
            data-testid="saved"
            data-state={saved ? "saved" : "saving"}
            data-revision={revision}
            title={words}
        >
            {saved ? (
                <Check className="saved-mark" size={14} aria-hidden="true" />
            ) : (
                <CloudUpload className="saved-mark" size={14} aria-hidden="true" />
            )}
            <span className={compact ? "unseen" : undefined}>{words}</span>
        </span>
    );
}
