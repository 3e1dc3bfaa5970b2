/* SPDX-License-Identifier: MIT */
/* The forms of the camera, the environment and the render settings. */
import { commandById, runCommand } from "../../model/commandLookup.ts";
import { Form } from "../form.tsx";
import { CommandButton } from "../layout/Act.tsx";
import { setups } from "../scene/Resources.tsx";
import { useDocument, useEditor } from "../state.ts";
import { t } from "../texts.ts";
import { Button } from "../widgets/Button.tsx";
import "./inspector.css";

export default function SetupInspector({ kind }: { kind: "camera" | "environment" | "render" }) {
    const params = useDocument((state) => state.schema[kind]);
    const setup = setups.find((one) => one.kind === kind) ?? setups[0];
    const title = t(setup?.title ?? "setup.camera");
    const Icon = setup?.icon;
    return (
        <div className="panel-scroll" data-testid="inspector">
            <header className="inspector-head">
                <span className="inspector-badge">
                    {Icon && <Icon size={18} aria-hidden="true" />}
                </span>
                <h2 className="inspector-title">{title}</h2>
            </header>
            {kind === "camera" && <CameraActs />}
            <div className="section-body setup-body">
                <Form params={params} base={`/${kind}`} owner={title} />
            </div>
        </div>
    );
}

function CameraActs() {
    const editor = useEditor();
    const run = (id: string) => () => {
        const command = commandById(id);
        if (command) {
            runCommand(editor, command);
        }
    };
    return (
        <div className="inspector-acts">
            <Button look="outline" onClick={run("camera.save")}>
                {t("inspector.takeView")}
            </Button>
            <Button look="outline" onClick={run("camera.document")}>
                {t("inspector.backToView")}
            </Button>
            <CommandButton id="camera.focus" />
        </div>
    );
}
