/* SPDX-License-Identifier: MIT */
/* Messages: the newest few in a corner, told politely to screen readers; all but errors leave by
 * themselves. */
import { CircleAlert, Info, TriangleAlert, X } from "lucide-react";
import { memo, useEffect } from "react";
import { commandById, runCommand } from "../../model/commandLookup.ts";
import { findResource } from "../../model/document.ts";
import { nodeOfPlace, resourceOfPlace } from "../../model/places.ts";
import { dismissNotice, type Notice, type NoticeAct } from "../../model/stores.ts";
import { showPlace } from "../insertions.ts";
import { placeTitle } from "../names.ts";
import { useDocument, useEditor, useNotices } from "../state.ts";
import { t, withUnits } from "../texts.ts";
import { Button, IconButton } from "../widgets/Button.tsx";
import "../view/view.css";

const MOST_SHOWN = 3;
const STAY_MS = 6000;

const icons = { info: Info, warning: TriangleAlert, error: CircleAlert };

export function Notices() {
    const notices = useNotices((state) => state.notices);
    const shown = notices.slice(-MOST_SHOWN);
    return (
        <section className="notices" aria-label={t("notices.title")} aria-live="polite">
            {shown.map((notice) => (
                <NoticeCard key={notice.id} notice={notice} />
            ))}
        </section>
    );
}

function ActButton({ act, id }: { act: NoticeAct; id: number }) {
    const editor = useEditor();
    /* What came later is not what the message is about. */
    const isPast = useDocument(
        ({ history }) => act.kind === "undo" && history.undo.at(-1)?.label !== act.label,
    );
    if (isPast) {
        return null;
    }
    const run = (): void => {
        if (act.kind === "undo") {
            const command = commandById("edit.undo");
            if (command && runCommand(editor, command) !== null) {
                return;
            }
        } else if ("run" in act) {
            act.run();
        } else if (act.kind === "retry") {
            editor.link.tryAgain(act.place);
        } else {
            editor.edit(act.ops, { label: act.label });
        }
        dismissNotice(editor.stores.notices, id);
    };
    return (
        <Button look="outline" onClick={run}>
            {t(
                act.kind === "retry" && act.slow
                    ? "notices.act.retrySlow"
                    : `notices.act.${act.kind}`,
            )}
        </Button>
    );
}

const NoticeCard = memo(function NoticeCard({ notice }: { notice: Notice }) {
    const editor = useEditor();
    const { stores } = editor;
    const { id, level, message, place, count, code, acts } = notice;
    const node = nodeOfPlace(place);
    const resource = resourceOfPlace(place);
    const known = useDocument(
        ({ document }) =>
            document !== null &&
            (document.nodes.has(node ?? "") ||
                (resource !== null &&
                    findResource(document, resource.list, resource.name) !== null)),
    );
    useEffect(() => {
        /* A question waits for its answer. */
        if (level === "error" || code === "trackpad") {
            return;
        }
        const timer = setTimeout(() => dismissNotice(stores.notices, id), STAY_MS);
        return () => clearTimeout(timer);
    }, [stores, id, level, code]);
    const where = useDocument(({ document }) => placeTitle(document, place));
    const Icon = icons[level];
    return (
        <div className="notice popup" data-level={level} data-code={code}>
            <Icon size={16} aria-hidden="true" />
            <div className="notice-text">
                {withUnits(message)}
                {count > 1 && ` (${t("notices.times", { count })})`}
                {place !== "" && <div className="notice-place">{where}</div>}
                {(acts.length > 0 || known) && (
                    <div className="notice-acts">
                        {acts.map((act) => (
                            <ActButton key={act.kind} act={act} id={id} />
                        ))}
                        {known && (
                            <Button look="outline" onClick={() => showPlace(editor, place, false)}>
                                {t("notices.show")}
                            </Button>
                        )}
                    </div>
                )}
            </div>
            <IconButton
                title={t("dismiss")}
                data-size="s"
                onClick={() => dismissNotice(stores.notices, id)}
            >
                <X size={14} />
            </IconButton>
        </div>
    );
});
