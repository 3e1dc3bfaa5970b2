/* SPDX-License-Identifier: MIT */
/* The page: the scene that the address names, or the start page; and what lies over both. */
import { Component, type ReactNode, useEffect } from "react";
import { isGone } from "../model/stores.ts";
import type { Editor } from "./editor.ts";
import { EditorPage } from "./layout/Editor.tsx";
import { useKeys } from "./layout/keys.ts";
import { Notices } from "./layout/Notices.tsx";
import { lazyPart, loadLazyParts } from "./lazy.tsx";
import { goTo, useRoute } from "./route.ts";
import { EditorContext, useDocument, useLink, useView } from "./state.ts";
import { t } from "./texts.ts";
import { useTheme } from "./theme.ts";
import { Button } from "./widgets/Button.tsx";
import { TipProvider } from "./widgets/Tip.tsx";
import "./widgets/theme.css";
import "./widgets/base.css";

const ScenesPage = lazyPart(() => import("./scenes/Scenes.tsx"));
const Palettes = lazyPart(() => import("./palettes/index.tsx"));

export function App({ editor }: { editor: Editor }) {
    return (
        <Guard>
            <EditorContext value={editor}>
                <TipProvider delay={500} closeDelay={50}>
                    <Pages editor={editor} />
                </TipProvider>
            </EditorContext>
        </Guard>
    );
}

function Pages({ editor }: { editor: Editor }) {
    const scene = useRoute();
    const popup = useView((view) => view.popup);
    const gone = useLink(isGone);
    const missing = useDocument(({ document }) => document === null) && gone;
    useTheme();
    useKeys(editor);
    useEffect(loadLazyParts, []);
    useEffect(() => {
        editor.open(scene);
    }, [editor, scene]);
    useEffect(() => {
        if (popup === "scenes") {
            editor.stores.view.setState({ popup: null });
            goTo(null);
        }
    }, [editor, popup]);
    return (
        <>
            {scene === null ? <ScenesPage /> : missing ? <Missing /> : <EditorPage />}
            <Palettes />
            <Notices />
        </>
    );
}

/* An address without a scene: nothing to use tools on. */
function Missing() {
    return (
        <main className="crash">
            <h1>{t("link.gone")}</h1>
            <Button look="primary" onClick={() => goTo(null)}>
                {t("bar.scenes")}
            </Button>
        </main>
    );
}

/* Shows what went wrong instead of a blank page. */
class Guard extends Component<{ children: ReactNode }, { error: Error | null }> {
    override state = { error: null as Error | null };

    static getDerivedStateFromError(error: Error) {
        return { error };
    }

    override render() {
        if (this.state.error === null) {
            return this.props.children;
        }
        return (
            <main className="crash">
                <h1>{t("app.failed")}</h1>
                <pre>{this.state.error.message}</pre>
                <Button look="primary" onClick={() => window.location.reload()}>
                    {t("app.reload")}
                </Button>
            </main>
        );
    }
}
