// node logic.mjs FOLDER: laws of what the page computes itself, as bundled there.
import assert from "node:assert/strict";
import {join} from "node:path";
import {test} from "node:test";
import {pathToFileURL} from "node:url";

const load = (name) => import(pathToFileURL(join(process.argv[2], name)));
const {visible, shortened, listed} = await load("words.js");
const {interpolated, residualsOf} = await load("residuals.js");
const {differencesOf} = await load("differences.js");
const {inWordsMeasurement, inWordsStated, inWordsDecided} = await load("measurement.js");
const {scaleOf, inWords, rounded, shown, withInterval, withSigma} = await load("scale.js");
const {begun, changed, configurationOf, fragmentOf, inWordsNotLoaded, modelFrom, modelOf, notLoaded, redone, undone, withFitted, withMeasured} = await load("state.js");

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
    assert.equal(withInterval(31.234, [8.129, 120.04]), "31.2, 8.13 to 120");
    assert.equal(withInterval(0, null), "0");
    assert.equal(inWords("dermal_hemoglobin_umol_per_l", "umol/L"), "dermal hemoglobin");
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

test("what is not to be seen is written out, and nothing else changes", () => {
    assert.equal(visible("Müller's arm, 45° – ½ 皮膚 <b>&amp;</b>"), "Müller's arm, 45° – ½ 皮膚 <b>&amp;</b>");
    assert.equal(visible("a\nb\tc\r\u001b[0m\u0000"), "a\\nb\\tc\\r\\x1b[0m\\x00");
    assert.equal(visible("\u202eabc\u2066\u200b\u2028\ufeff\u{e0041}\ud800"), "\\u202eabc\\u2066\\u200b\\u2028\\ufeff\\ue0041\\ud800");
    assert.equal(visible("\u0085\u009b"), "\\u0085\\u009b");
    assert.equal(shortened("\n".repeat(40), 8), "\\n\\n\\n\\…");
    assert.deepEqual([[], ["a"], ["a", "b"], ["a", "b", "c"]].map(listed), ["", "a", "a and b", "a, b and c"]);
});

test("a curve is interpolated exactly where it is a cubic, and not beyond what is known", () => {
    const cubic = (x) => 1e-6 * (x - 500) ** 3 + 0.002 * x;
    const x = [400, 402, 404, 407, 410, 420];
    for (const at of [400.5, 403, 405.9, 409, 419]) assert.ok(Math.abs(interpolated(x, x.map(cubic), at) - cubic(at)) < 1e-12);
    for (const [i, at] of x.entries()) assert.equal(interpolated(x, x.map(cubic), at), x.map(cubic)[i]);
    for (const at of [399, 421]) assert.equal(interpolated(x, x.map(cubic), at), null);
    assert.equal(interpolated([400, 450], [0, 1], 425), null);
    assert.equal(interpolated([400, 410], [0, 1], 405), 0.5);
    assert.deepEqual(residualsOf({wavelength_nm: [400, 410], reading: [0.5, 0.5]}, {wavelength_nm: [390, 400, 405], value: [0, 0.25, 0.75]}),
        {x: [400, 405], y: [0.25, -0.25], indices: [1, 2]});
});

test("what a file may decide is left to it until it is set", () => {
    const model = modelOf({parameters: {scale: {value: 1}}, free: ["scale"], own: [], edition: "revised", layers: 4, starts: 8, noise: null}, ["edition", "layers"]);
    assert.deepEqual(model.settings, {edition: null, layers: null, starts: 8, noise: null});
    assert.deepEqual(configurationOf(model), {starts: 8, parameters: {scale: 1}, free: ["scale"]});
    // Set to what is the default all the same, a link holds it.
    const set = {...model, settings: {...model.settings, edition: "revised"}};
    assert.equal(fragmentOf(set, model), "edition=revised");
    const fitted = withFitted(set, {parameters: {scale: {value: 1.2}, "scale[2]": {value: 3}}}, {edition: null, layers: 2});
    assert.deepEqual([fitted.values, fitted.settings.edition, fitted.settings.layers], [{scale: 1.2}, null, 2]);
});

test("a link sets nothing that the page does not offer", () => {
    const offered = {edition: ["printed", "revised"]};
    assert.equal(modelFrom("#edition=first", defaults, offered).complaints.length, 1);
    assert.equal(modelFrom("#edition=first", defaults, offered).model.settings.edition, "revised");
    assert.equal(modelFrom("#edition=printed", defaults, offered).model.settings.edition, "printed");
});

test("a measurement is told in words", () => {
    const names = ["quantity", "incidence_deg", "specular", "viewing_cone_deg", "bandpass_shape", "bandpass_width_nm", "edition"];
    assert.equal(inWordsMeasurement({quantity: "reflectance", incidence_deg: 45, specular: "excluded", viewing_cone_deg: null, bandpass_shape: "triangular", bandpass_width_nm: 0}, names),
        "reflectance, incidence 45°, specular excluded");
    assert.equal(inWordsMeasurement({viewing_cone_deg: 5, bandpass_shape: "gaussian", bandpass_width_nm: 10}, names), "viewed within 5° of the normal, bandpass shape gaussian, bandpass 10 nm");
    assert.equal(inWordsStated({name: "a", incidence_deg: 8, notes: [["edition", "printed"], ["site", "arm"]], value: [1], wavelength_nm: [1]}, names), "incidence 8°, edition printed");
    const decided = {measurement: {incidence_deg: 45, viewing_cone_deg: null}, decided_by: {incidence_deg: "file", viewing_cone_deg: "default"}};
    assert.equal(inWordsDecided("incidence_deg", decided), "45 (file)");
    assert.equal(inWordsDecided("viewing_cone_deg", decided), "hemisphere (default)");
});

test("two fits differ in what differs, and in nothing else", () => {
    const parameter = (value, status, start = value) => ({value, start, status, sigma: null, interval_95: [0, 1], unit: ""});
    const fit = (changes = {}, configuration = {}, parameters = {}) => ({source: "a.csv", ...changes, report: {
        spectrum: {name: "arm"}, wavelength_nm: [400, 700], ...changes.report,
        parameters: {scale: parameter(1.1, "free", 1), offset: parameter(0, "fixed"), ...parameters},
        configuration: {edition: "revised", exclude_nm: [], noise: 0.006, free: ["scale"], parameters: {scale: {value: 1.1, lower: 0.5, upper: 2}}, ...configuration},
    }});
    const names = (...fits) => differencesOf(fits).map(({name}) => name);
    // The answer itself is no difference of what was asked.
    assert.deepEqual(names(fit(), fit({}, {}, {scale: parameter(1.3, "free", 1)})), []);
    assert.deepEqual(names(fit(), fit({source: "b.csv"})), ["file"]);
    assert.deepEqual(differencesOf([fit(), fit({}, {edition: "printed", exclude_nm: [[500, 510]]})]),
        [{name: "edition", values: ["revised", "printed"]}, {name: "exclude (nm)", values: ["none", "[[500,510]]"]}]);
    assert.deepEqual(differencesOf([fit(), fit({}, {discrepancy: {sigma: 0.005, kernel: "matern_3_2"}})]),
        [{name: "discrepancy", values: ["none", "sigma 0.005, kernel matern_3_2"]}]);
    assert.deepEqual(differencesOf([fit(), fit({}, {}, {offset: parameter(0.01, "at lower bound", 0)})]), [{name: "free beside the others", values: ["none", "offset"]}]);
    assert.deepEqual(differencesOf([fit(), fit({}, {}, {offset: parameter(0.02, "fixed")})]), [{name: "offset, held", values: ["0", "0.02"]}]);
    assert.deepEqual(names(fit(), fit({}, {}, {scale: parameter(1.1, "free", 0.9)})), ["scale, start"]);
    assert.deepEqual(differencesOf([fit(), fit({}, {parameters: {scale: {value: 1.1, lower: 0.9, upper: 2}}})]), [{name: "scale, limits", values: ["lower 0.5, upper 2", "lower 0.9, upper 2"]}]);
    assert.deepEqual(differencesOf([fit(), fit({report: {wavelength_nm: [450, 500, 700], spectrum: {name: "leg"}}})]),
        [{name: "spectrum", values: ["arm", "leg"]}, {name: "readings", values: ["2, 400 to 700 nm", "3, 450 to 700 nm"]}]);
    const joint = fit({report: {spectra: [{name: "a", wavelength_nm: [400]}, {name: "b", wavelength_nm: [500, 700]}]}});
    assert.deepEqual(names(fit(), joint), ["spectrum", "readings"]);
});
