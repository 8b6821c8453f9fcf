import {useLayoutEffect, useRef} from "preact/hooks";
import uPlot from "uplot";
import {Scrolled} from "./scrolled";

/// A curve, points, an area that stands on the one before it, or an edge of a band, of which two follow each other.
export interface Curve {
    label: string;
    x: number[];
    y: number[];
    colour: string;
    look: "line" | "dashed" | "points" | "area" | "edge";
    share?: number[];  ///< of an area: its own height, for the numbers
}

interface PlotProps {
    curves: Curve[];
    yLabel: string;
    description: string;  ///< for those who do not see it
    fromZero?: boolean;
    top?: number;
    isSmall?: boolean;          ///< stands below another plot, which has the legend
    xRange?: [number, number];  ///< of the other plot
    onDrawn?: () => void;
}

const css = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/// What the numbers say at a place of the joined data.
const numberAt = (curve: Curve | undefined, joinedValue: number | null | undefined, place: number) =>
    (curve?.share?.[place] ?? joinedValue)?.toFixed(4) ?? "–";

function seriesOf(curve: Curve, latest: () => Curve[]): uPlot.Series {
    const isPoints = curve.look === "points";
    return {
        label: curve.label,
        stroke: curve.colour,
        width: isPoints || curve.look === "edge" ? 0 : curve.look === "area" ? 1 : 2,
        ...(curve.look === "dashed" ? {dash: [6, 4]} : {}),
        ...(curve.look === "area" ? {fill: curve.colour} : {}),
        points: {show: isPoints, size: 6, ...(isPoints ? {fill: curve.colour} : {})},
        value: (_, value, series, place) => (place === null ? "–" : numberAt(latest()[series - 1], value, place)),
    };
}

function joined(curves: Curve[]): uPlot.AlignedData {
    if (curves.length === 0) return [[]];
    return uPlot.join(curves.map(({x, y}) => [x, y]));
}

/// Between two edges.
const bandsOf = (curves: Curve[]): uPlot.Band[] => curves.flatMap((curve, k) =>
    curve.look === "edge" && curves[k + 1]?.look === "edge" ? [{series: [k + 1, k + 2] as [number, number], fill: `${curve.colour}38`}] : []);

function optionsOf(latest: () => PlotProps, width: number, height: number, onDraw: () => void): uPlot.Options {
    const props = latest();
    const axis: uPlot.Axis = {
        stroke: css("--quiet"),
        grid: {stroke: css("--line"), width: 1},
        ticks: {stroke: css("--line"), width: 1},
        font: `12px ${css("--font")}`,
        labelFont: `12px ${css("--font")}`,
    };
    return {
        width,
        height,
        padding: [props.isSmall ? 4 : 12, 12, 0, 0],
        legend: {show: !props.isSmall},
        bands: bandsOf(props.curves),
        cursor: {drag: {x: false, y: false}, points: {size: 7}},
        scales: {
            x: {time: false, ...(props.xRange ? {range: () => latest().xRange!} : {})},
            y: {
                range: (_, low, high) => {
                    const bottom = props.fromZero && low >= 0 ? 0 : low;
                    const edge = props.top ?? high + 0.06 * (high - bottom || 1);
                    return [bottom === 0 ? 0 : bottom - 0.06 * (high - bottom || 1), edge];
                },
            },
        },
        axes: [
            props.isSmall ? {...axis, size: 6, values: () => []} : {...axis, label: "wavelength / nm", labelSize: 22, size: 34},
            {...axis, label: props.yLabel, labelSize: 22, size: 58, ...(props.isSmall ? {space: 22} : {})},
        ],
        series: [
            {label: "nm", value: (_, value) => (value === null || value === undefined ? "–" : String(value))},
            ...props.curves.map((curve) => seriesOf(curve, () => latest().curves)),
        ],
        hooks: {draw: [onDraw]},
    };
}

/// What needs another plot rather than other data.
const shapeOf = (props: PlotProps) =>
    JSON.stringify([props.yLabel, props.fromZero, props.top, props.isSmall, props.curves.map(({label, colour, look}) => [label, colour, look])]);

export function Plot(props: PlotProps) {
    const box = useRef<HTMLDivElement>(null);
    const plot = useRef<uPlot | null>(null);
    const latest = useRef(props);
    latest.current = props;
    const shape = shapeOf(props);

    useLayoutEffect(() => {
        const element = box.current;
        if (!element) return;
        const size = () => ({width: element.clientWidth, height: parseInt(css(props.isSmall ? "--residual-height" : "--plot-height"))});
        const make = () => {
            plot.current?.destroy();
            const {width, height} = size();
            plot.current = new uPlot(optionsOf(() => latest.current, width, height, () => latest.current.onDrawn?.()),
                joined(latest.current.curves), element);
        };
        make();
        const resized = new ResizeObserver(() => plot.current?.setSize(size()));
        resized.observe(element);
        const scheme = matchMedia("(prefers-color-scheme: dark)");
        scheme.addEventListener("change", make);
        return () => {
            resized.disconnect();
            scheme.removeEventListener("change", make);
            plot.current?.destroy();
            plot.current = null;
        };
    }, [shape]);

    useLayoutEffect(() => plot.current?.setData(joined(props.curves)), [props.curves]);

    return (
        <>
            <div class={props.isSmall ? "residuals" : "plot"} role="img" aria-label={props.description} ref={box} />
            <details class="numbers">
                <summary>{props.isSmall ? "The residuals in numbers" : "The same in numbers"}</summary>
                <NumberTable curves={props.curves} label={props.isSmall ? "values of the residuals" : "values of the curves"} />
            </details>
        </>
    );
}

function NumberTable({curves, label}: {curves: Curve[]; label: string}) {
    const [wavelengths, ...columns] = joined(curves);
    return (
        <Scrolled label={label}>
            <table>
                <thead>
                    <tr>
                        <th scope="col">nm</th>
                        {curves.map((curve) => <th scope="col">{curve.label}</th>)}
                    </tr>
                </thead>
                <tbody>
                    {Array.from(wavelengths ?? [], (wavelength, row) => (
                        <tr>
                            <th scope="row">{wavelength}</th>
                            {columns.map((column, k) => <td>{numberAt(curves[k], column[row], row)}</td>)}
                        </tr>
                    ))}
                </tbody>
            </table>
        </Scrolled>
    );
}
