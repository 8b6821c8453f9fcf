// node logic.mjs FOLDER: laws of what the page computes itself, as bundled there.
import assert from "node:assert/strict";
import {join} from "node:path";
import {test} from "node:test";
import {pathToFileURL} from "node:url";

const load = (name) => import(pathToFileURL(join(process.argv[2], name)));
const {scaleOf, rounded, shown, withSigma} = await load("scale.js");
const {begun, changed, fragmentOf, inWordsNotLoaded, modelFrom, notLoaded, redone, undone, withMeasured} = await load("state.js");

const parameters = [
    {lower: 0, upper: 0.5, logarithmic: true},
    {lower: 0, upper: 1, logarithmic: false},
    {lower: 0.005, upper: 0.05, logarithmic: true},
    {lower: -5, upper: 5, logarithmic: false},
    {lower: 1.3, upper: 1.6, logarithmic: false},
];

test("a slider's position and its value belong together, ends included", () => {
    for (const parameter of parameters) {
        const scale = scaleOf(parameter);
        assert.equal(scale.toValue(0), parameter.lower);
        assert.ok(Math.abs(scale.toValue(1) - parameter.upper) <= 1e-12 * parameter.upper);
        for (let position = 0; position <= 1; position += 0.01) {
            assert.ok(Math.abs(scale.toPosition(scale.toValue(position)) - position) < 1e-12);
        }
        assert.equal(scale.toPosition(parameter.upper * 2), 1);
        assert.equal(scale.toPosition(parameter.lower - 1), 0);
    }
});

test("a scale is logarithmic where the server says so", () => {
    assert.deepEqual(parameters.map((each) => scaleOf(each).kind), ["logarithmic", "linear", "logarithmic", "linear", "linear"]);
});

test("numbers are written as reports write them", () => {
    assert.equal(rounded(0.123456), 0.123);
    assert.equal(shown(0), "0");
    assert.equal(shown(2.1e-4), "2.10e-4");
    assert.equal(withSigma(0.010188, 0.00034), "0.01019 ± 0.00034");
    assert.equal(withSigma(153.21, 12), "153 ± 12");
});

const defaults = {values: {melanosome_fraction: 0.052, scale: 1}, settings: {edition: "revised", base: null, discrepancy: null}, free: ["scale"]};

test("a link restores what it was made of", () => {
    for (const model of [
        defaults,
        {...defaults, values: {melanosome_fraction: 1e-7, scale: 1.1}},
        {...defaults, settings: {edition: "printed", base: 1.33, discrepancy: {sigma: 0.005}}, free: []},
        {...defaults, free: ["melanosome_fraction", "scale"]},
    ]) {
        assert.deepEqual(modelFrom("#" + fragmentOf(model, defaults), defaults), {model, complaints: []});
    }
    assert.equal(fragmentOf(defaults, defaults), "");
});

test("a link with mistakes says so and keeps the rest", () => {
    const {model, complaints} = modelFrom("#melanosome_fraction=much&nowhere=1&scale=2&free=scale,nothing", defaults);
    assert.equal(complaints.length, 3);
    assert.equal(model.values.scale, 2);
    assert.equal(model.values.melanosome_fraction, 0.052);
});

test("a link names measured files without their folders, and tells those that are missing", () => {
    const model = {...defaults, values: {melanosome_fraction: 0.1, scale: 1}};
    const fragment = withMeasured(fragmentOf(model, defaults), ["/home/me/arm & leg.csv", "C:\\data\\b=c.csv", "other/arm & leg.csv"]);
    assert.ok(!/home|data|other/.test(fragment));
    assert.deepEqual(modelFrom("#" + fragment, defaults), {model, complaints: []});
    assert.deepEqual(notLoaded("#" + fragment, []), ["arm & leg.csv", "b=c.csv"]);
    assert.deepEqual(notLoaded("#" + fragment, ["/elsewhere/b=c.csv"]), ["arm & leg.csv"]);
    assert.deepEqual(notLoaded("#" + fragment, ["arm & leg.csv", "b=c.csv", "more.csv"]), []);
    assert.deepEqual(notLoaded("", ["a.csv"]), []);
    assert.equal(withMeasured("", []), "");
    assert.match(inWordsNotLoaded(["a.csv", "b.csv"]), /a\.csv and b\.csv.*choose them/);
});

test("undo and redo go back and forth, a movement in one step", () => {
    const model = (scale) => ({...defaults, values: {...defaults.values, scale}});
    let history = begun(model(1));
    for (const scale of [1.1, 1.2, 1.3]) history = changed(history, model(scale), false);
    history = changed(history, model(1.3), true);
    history = changed(history, model(2));
    assert.equal(undone(history).present.values.scale, 1.3);
    assert.equal(undone(undone(history)).present.values.scale, 1);
    assert.equal(undone(undone(undone(history))).present.values.scale, 1);
    assert.deepEqual(redone(redone(undone(undone(history)))), history);
    assert.equal(changed(undone(history), model(3)).future.length, 0);
});
