/* SPDX-License-Identifier: MIT */
/* Points of the plane: dragged on a grid, put in on an edge, typed below it. What is dragged moves
 * in the picture at once; by keys, a point is moved by its arrows. */
import { Minus, Plus } from "lucide-react";
import { useRef, useState } from "react";
import { numberParam, type Param } from "../../model/schema.ts";
import { snap, tidy } from "../../model/units.ts";
import { pointsOf } from "../../model/values.ts";
import { t } from "../texts.ts";
import { IconButton } from "../widgets/Button.tsx";
import { type Frame, frameOf, type Point, pointAt, ticksOf, toView } from "./grid.ts";
import { NumberField } from "./Number.tsx";
import type { FieldProps } from "./types.ts";
import "./fields.css";

interface Props extends FieldProps<readonly (readonly number[])[]> {
    param: Param;
}

const axisParams = [
    numberParam("x", { unit: "length" }),
    numberParam("y", { unit: "length" }),
] as const;

/* The points of one outline mean nothing in another one, so nothing is changed where they differ. */
export default function PointsField(props: Props) {
    return props.mixed ? (
        <p className="points-mixed">{t("points.mixed")}</p>
    ) : (
        <SamePoints {...props} />
    );
}

function SamePoints(props: Props) {
    const { param, label, value, describedBy, onInput, onCommit, onCancel, onRefuse } = props;
    const points = pointsOf(value);
    const [chosen, setChosen] = useState(0);
    const now = Math.min(chosen, points.length - 1);
    const point = points[now];
    const most = param.max ?? Number.POSITIVE_INFINITY;
    const least = param.min ?? 0;
    const moved = (index: number, to: Point): Point[] =>
        points.map((old, i) => (i === index ? to : old));
    /* Between a point and the one after it. */
    const insert = (index: number): void => {
        const [a, b] = [points[index], points[(index + 1) % points.length]];
        if (a && b && points.length < most) {
            const middle: Point = [tidy((a[0] + b[0]) / 2), tidy((a[1] + b[1]) / 2)];
            setChosen(index + 1);
            onCommit([...points.slice(0, index + 1), middle, ...points.slice(index + 1)]);
        }
    };
    const remove = (): void => {
        if (points.length > least) {
            setChosen(Math.max(0, now - 1));
            onCommit(points.filter((_, i) => i !== now));
        }
    };
    return (
        // biome-ignore lint/a11y/useSemanticElements: a fieldset brings a look and a legend of its own
        <div className="points" role="group" aria-label={label} aria-describedby={describedBy}>
            <Plane
                label={label}
                points={points}
                chosen={now}
                onChoose={setChosen}
                onInput={(index, to) => onInput(moved(index, to))}
                onCommit={(index, to) => onCommit(moved(index, to))}
                onCancel={onCancel}
                onInsert={points.length < most ? insert : null}
                onRemove={remove}
            />
            {point && (
                <div className="points-row">
                    <span className="points-count">
                        {t("points.which", { number: now + 1, count: points.length })}
                    </span>
                    {axisParams.map((row, i) => (
                        <NumberField
                            key={row.name}
                            param={row}
                            axis={row.name === "x" ? "x" : "y"}
                            label={t("points.axis", { number: now + 1, axis: row.name })}
                            value={point[i] ?? 0}
                            fallback={0}
                            onInput={(x) => onInput(moved(now, withPart(point, i, x)))}
                            onCommit={(x) => onCommit(moved(now, withPart(point, i, x)))}
                            onCancel={onCancel}
                            onRefuse={onRefuse}
                        />
                    ))}
                    <IconButton
                        title={t("points.add")}
                        data-size="s"
                        whyNot={points.length < most ? null : t("points.most", { count: most })}
                        onClick={() => insert(now)}
                    >
                        <Plus size={14} />
                    </IconButton>
                    <IconButton
                        title={t("points.remove")}
                        data-size="s"
                        whyNot={points.length > least ? null : t("points.least", { count: least })}
                        onClick={remove}
                    >
                        <Minus size={14} />
                    </IconButton>
                </div>
            )}
        </div>
    );
}

function withPart(point: Point, part: number, x: number): Point {
    return part === 0 ? [x, point[1]] : [point[0], x];
}

interface PlaneProps {
    label: string;
    points: readonly Point[];
    chosen: number;
    onChoose: (index: number) => void;
    onInput: (index: number, to: Point) => void;
    onCommit: (index: number, to: Point) => void;
    onCancel: () => void;
    onInsert: ((index: number) => void) | null;
    onRemove: () => void;
}

interface Drag {
    index: number;
    frame: Frame;
    start: Point;
    at: Point;
}

const same = (a: Point, b: Point): boolean => a[0] === b[0] && a[1] === b[1];

const ARROWS: Record<string, readonly [number, number]> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, 1],
    ArrowDown: [0, -1],
};

function Plane(props: PlaneProps) {
    const { points, chosen, onChoose, onInsert } = props;
    const plane = useRef<SVGSVGElement>(null);
    const [drag, setDrag] = useState<Drag | null>(null);
    /* The frame stays while something is dragged, or it would run away from under the pointer. */
    const frame = drag?.frame ?? frameOf(points);
    const step = frame.tick / 10;
    const seen = points.map((point) => toView(frame, point));
    const find = (event: React.PointerEvent, of: Frame): Point => {
        const box = plane.current?.getBoundingClientRect() ?? new DOMRect(0, 0, 1, 1);
        const [x, y] = pointAt(
            of,
            (event.clientX - box.x) / box.width,
            (event.clientY - box.y) / box.height,
        );
        const by = event.ctrlKey || event.metaKey ? of.tick : of.tick / 20;
        return [snap(x, by), snap(y, by)];
    };
    const press = (index: number) => (event: React.PointerEvent<SVGElement>) => {
        if (event.button === 0) {
            event.currentTarget.setPointerCapture(event.pointerId);
            onChoose(index);
            const start = points[index] ?? [0, 0];
            setDrag({ index, frame, start, at: start });
        }
    };
    const move = (event: React.PointerEvent): void => {
        if (drag) {
            const at = find(event, drag.frame);
            if (!same(at, drag.at)) {
                setDrag({ ...drag, at });
                props.onInput(drag.index, at);
            }
        }
    };
    const release = (): void => {
        setDrag(null);
        if (drag && !same(drag.at, drag.start)) {
            props.onCommit(drag.index, drag.at);
        }
    };
    const key = (index: number) => (event: React.KeyboardEvent) => {
        const [x, y] = points[index] ?? [0, 0];
        const by = ARROWS[event.key];
        const size = event.shiftKey ? frame.tick : step;
        if (event.key === "Escape" && drag) {
            event.stopPropagation();
            setDrag(null);
            props.onCancel();
        } else if (by) {
            event.preventDefault();
            props.onCommit(index, [tidy(x + by[0] * size), tidy(y + by[1] * size)]);
        } else if (event.key === "Delete" || event.key === "Backspace") {
            event.preventDefault();
            event.stopPropagation();
            props.onRemove();
        } else if (event.key === "Insert" || event.key === "+") {
            event.preventDefault();
            event.stopPropagation();
            onInsert?.(index);
        }
    };
    return (
        // biome-ignore lint/a11y/useSemanticElements: there are no fieldsets in a drawing
        <svg
            ref={plane}
            className="points-plane"
            viewBox={`0 0 ${frame.width} ${frame.height}`}
            role="group"
            aria-label={t("points.plane", { name: props.label })}
        >
            <Grid frame={frame} />
            <path className="points-shape" d={`M${seen.map((p) => p.join(" ")).join("L")}Z`} />
            {onInsert &&
                seen.map(([x, y], i) => {
                    const [u, v] = seen[(i + 1) % seen.length] ?? [x, y];
                    return (
                        <circle
                            // biome-ignore lint/suspicious/noArrayIndexKey: points have no other name
                            key={i}
                            className="points-middle"
                            cx={(x + u) / 2}
                            cy={(y + v) / 2}
                            r={4}
                            onPointerDown={() => onInsert(i)}
                        >
                            <title>{t("points.add")}</title>
                        </circle>
                    );
                })}
            {seen.map(([x, y], i) => (
                // biome-ignore lint/a11y/useSemanticElements: there are no buttons in a drawing
                <g
                    // biome-ignore lint/suspicious/noArrayIndexKey: points have no other name
                    key={i}
                    className="points-point"
                    role="button"
                    tabIndex={0}
                    aria-label={t("points.point", {
                        number: i + 1,
                        x: points[i]?.[0] ?? 0,
                        y: points[i]?.[1] ?? 0,
                    })}
                    aria-pressed={i === chosen}
                    onFocus={() => onChoose(i)}
                    onPointerDown={press(i)}
                    onPointerMove={move}
                    onPointerUp={release}
                    onPointerCancel={release}
                    onKeyDown={key(i)}
                >
                    <circle className="points-grip" cx={x} cy={y} r={12} />
                    <circle className="points-dot" cx={x} cy={y} r={5} />
                </g>
            ))}
        </svg>
    );
}

function Grid({ frame }: { frame: Frame }) {
    const { width, height } = frame;
    const [zeroX, zeroY] = toView(frame, [0, 0]);
    return (
        // biome-ignore lint/a11y/noAriaHiddenOnFocusable: nothing in it can have the focus
        <g aria-hidden="true">
            {ticksOf(frame, 0).map((x) => (
                <line key={`x${x}`} className="points-line" x1={x} x2={x} y1={0} y2={height} />
            ))}
            {ticksOf(frame, 1).map((y) => (
                <line key={`y${y}`} className="points-line" x1={0} x2={width} y1={y} y2={y} />
            ))}
            <line className="points-axis" data-axis="x" x1={0} x2={width} y1={zeroY} y2={zeroY} />
            <line className="points-axis" data-axis="y" x1={zeroX} x2={zeroX} y1={0} y2={height} />
            <text className="points-scale" x={width - 6} y={height - 6}>
                {tidy(frame.tick)}
            </text>
        </g>
    );
}
