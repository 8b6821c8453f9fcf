// node explore.mjs PROGRAM SOURCE_FOLDER PICTURES_FOLDER
import assert from "node:assert/strict";
import {mkdirSync, readFileSync} from "node:fs";
import {join} from "node:path";
import {after, before, test} from "node:test";
import {browse, drop, hue, news, number, numbers, openPage, serve, skipWithoutBrowser, slider, source, until} from "./session.mjs";

skipWithoutBrowser();
const pictures = process.argv[4];
mkdirSync(pictures, {recursive: true});
const specimen = readFileSync(join(source, "measurements/data/ncsu_113.csv"), "utf8");
const axe = readFileSync(new URL("node_modules/axe-core/axe.min.js", import.meta.url), "utf8");

let server, browser;
before(async () => {
    server = await serve();
    browser = await browse();
});
after(async () => {
    await browser?.close();
    await server?.stop();
});

/// A test with a page of its own, which must not make the browser complain.
const onPage = (name, act, {complaints = false} = {}) => test(name, async (t) => {
    const page = await openPage(browser.context, server.url);
    try {
        await act(page, t);
        if (!complaints) assert.deepEqual(page.complaints, []);
        assert.deepEqual(page.foreign, []);
    } finally {
        await page.close();
    }
});

const pixels = (page) => page.locator(".plot canvas").evaluate((canvas) => canvas.toDataURL());

/// Drops the specimen and waits for the fit `number` of it.
async function fitSpecimen(page) {
    await drop(page, "ncsu_113.csv", specimen);
    await page.getByRole("button", {name: "Fit", exact: true}).click();
    await page.getByRole("table", {name: "Fitted values"}).waitFor({timeout: 120_000});
}

onPage("loads with the curve of the default skin", async (page) => {
    assert.equal(await page.title(), "skinfit explore");
    assert.match(await hue(page), /#[0-9a-f]{6}/);
    await page.getByText("The same in numbers").click();
    assert.equal(await page.locator(".numbers tbody tr").count(), 151);
    const {labels, rows} = await numbers(page);
    assert.deepEqual(labels, ["model"]);
    // Between its two bands, at 542 and 577 nm, oxygenated blood lets the curve rise.
    await number(page, "oxygen_saturation").fill("0.95");
    await number(page, "papillary_blood_fraction").fill("0.05");
    await page.keyboard.press("Tab");
    const dips = await until(async () => {
        const {rows: now} = await numbers(page);
        return now.filter(({nm, values: [value]}, i) => nm > 500 && nm < 620 && value < now[i - 1].values[0] && value < now[i + 1].values[0]).map(({nm}) => nm);
    }, (found) => found.length === 2, "two dips");
    assert.ok(dips[0] < 560 && dips[1] > 560, String(dips));
    assert.equal(rows.length, 151);
});

onPage("shows nothing without the token", async (page) => {
    const {origin} = new URL(server.url);
    await page.goto(origin);
    await page.getByRole("alert").waitFor();
    assert.match(await page.getByRole("alert").textContent(), /token/);
}, {complaints: true});

onPage("moves the curve and the colour with a slider, by keyboard alone", async (page) => {
    const [curve, colour] = [await pixels(page), await hue(page)];
    await slider(page, "melanosome_fraction").focus();
    await page.keyboard.press("End");
    await until(() => hue(page), (now) => now !== colour, "another colour");
    assert.notEqual(await pixels(page), curve);
    assert.equal(await number(page, "melanosome_fraction").inputValue(), "0.5");
});

onPage("takes numbers, and says what is wrong with one", async (page) => {
    const colour = await hue(page);
    await number(page, "papillary_blood_fraction").fill("0.2");
    await page.keyboard.press("Tab");
    await until(() => hue(page), (now) => now !== colour, "another colour");
    await number(page, "papillary_blood_fraction").fill("7");
    await page.keyboard.press("Tab");
    await page.getByRole("alert").waitFor();
    assert.match(await page.getByRole("alert").textContent(), /papillary_blood_fraction.*out of range/);
    await page.getByRole("button", {name: "Undo"}).click();
    await page.getByRole("alert").waitFor({state: "detached"});
}, {complaints: true});

onPage("undoes, redoes, and comes back from its link", async (page) => {
    const begin = await number(page, "melanosome_fraction").inputValue();
    await slider(page, "melanosome_fraction").focus();
    await page.keyboard.press("End");
    await page.locator("input[value=printed]").check({force: true});
    await page.getByRole("button", {name: "Undo"}).click();
    await until(() => page.locator("input[value=revised]").isChecked(), Boolean, "the edition of before");
    await page.getByRole("button", {name: "Undo"}).click();
    assert.equal(await number(page, "melanosome_fraction").inputValue(), begin);
    await page.getByRole("button", {name: "Redo"}).click();
    await page.getByRole("button", {name: "Redo"}).click();
    await until(() => page.url(), (url) => url.includes("edition=printed"), "the link");
    await until(() => page.locator(".drawn-for").textContent(), (words) => /edition printed/.test(words), "the printed edition");
    const colour = await until(() => hue(page), Boolean, "a colour");
    await page.reload();
    await page.waitForSelector(".plot canvas");
    assert.equal(await number(page, "melanosome_fraction").inputValue(), "0.5");
    assert.ok(await page.locator("input[value=printed]").isChecked());
    await until(() => hue(page), (now) => now === colour, "the same colour");
});

onPage("keeps a number that is being typed while answers come in", async (page) => {
    await number(page, "melanosome_fraction").fill("0.1");
    await drop(page, "ncsu_113.csv", specimen);
    await page.getByRole("button", {name: "Remove ncsu_113.csv"}).waitFor();
    assert.equal(await number(page, "melanosome_fraction").inputValue(), "0.1");
    await page.keyboard.press("Tab");
    await until(() => page.url(), (url) => url.includes("melanosome_fraction=0.1"), "the link");
    // Two files dropped at once are both there.
    await Promise.all([drop(page, "a.csv", specimen), drop(page, "b.csv", specimen)]);
    for (const name of ["a.csv", "b.csv"]) await page.getByRole("button", {name: `Remove ${name}`}).waitFor();
    // A field left empty shows the number that holds.
    await number(page, "melanosome_fraction").fill("");
    await page.keyboard.press("Tab");
    assert.equal(await number(page, "melanosome_fraction").inputValue(), "0.1");
});

onPage("says which measured file its link names, and what to do", async (page) => {
    await drop(page, "ncsu_113.csv", specimen);
    await number(page, "melanosome_fraction").fill("0.1");
    await page.keyboard.press("Tab");
    await until(() => page.url(), (url) => url.includes("melanosome_fraction=0.1") && url.includes("measured=ncsu_113.csv"), "the link");
    await page.reload();
    await page.waitForSelector(".plot canvas");
    assert.equal(await number(page, "melanosome_fraction").inputValue(), "0.1");
    const alert = page.getByRole("alert");
    await alert.waitFor();
    assert.match(await alert.textContent(), /the measured file ncsu_113\.csv, which a link does not hold.*choose it under .Measured spectra., or drop it anywhere on the page/);
    await page.screenshot({path: join(pictures, "explore_link_without_file.png")});
    // The link goes on naming it, so that it can be passed on.
    assert.ok(page.url().includes("measured=ncsu_113.csv"));
    await drop(page, "ncsu_113.csv", specimen);
    await alert.waitFor({state: "detached"});
    await page.getByRole("button", {name: "Remove ncsu_113.csv"}).click();
    await until(() => page.url(), (url) => !url.includes("measured="), "a link without it");
    assert.equal(await alert.count(), 0);
    await page.evaluate(() => { location.hash = "#scale=1.1&measured=a.csv&measured=b.csv"; });
    await alert.waitFor();
    assert.match(await alert.textContent(), /a\.csv and b\.csv/);
    assert.equal(await number(page, "scale").inputValue(), "1.1");
    await page.getByRole("button", {name: "Do without"}).click();
    await alert.waitFor({state: "detached"});
    await until(() => page.url(), (url) => !url.includes("measured="), "a link without them");
});

onPage("shows absorption and sensitivity, the tabs by arrow keys", async (page) => {
    await page.getByRole("tab", {name: "spectrum"}).focus();
    await page.keyboard.press("ArrowRight");
    await page.getByText("Stacked shares").waitFor();
    await page.keyboard.press("ArrowRight");
    await page.getByText("Change of the reading for").waitFor();
});

onPage("overlays a dropped file, fits it, compares fits and takes one over", async (page) => {
    await fitSpecimen(page);
    assert.match(await news(page).textContent(), /^fit 1: (consistent|suspect)$/);
    await page.getByText("How it is fitted").click();
    await page.getByLabel("allow for the model").check();
    await page.getByRole("button", {name: "Fit", exact: true}).click();
    await page.getByRole("columnheader", {name: "fit 2"}).waitFor({timeout: 120_000});
    const row = page.getByRole("row", {name: /^melanosome fraction/}).last();
    assert.match(await row.textContent(), /±.*±/);
    await page.getByRole("button", {name: "sliders to fit 1"}).click();
    assert.notEqual(await number(page, "melanosome_fraction").inputValue(), "0.052");
});

/// The largest difference of two curves in the numbers under a plot, where both have a value.
async function difference(page, one, other) {
    const {labels, rows} = await numbers(page);
    const [a, b] = [one, other].map((label) => labels.indexOf(label));
    assert.ok(a >= 0 && b >= 0, labels.join(", "));
    const both = rows.filter(({values}) => values[a] !== null && values[b] !== null);
    assert.ok(both.length > 20, `${both.length} common wavelengths`);
    return Math.max(...both.map(({values}) => Math.abs(values[a] - values[b])));
}

const comment = (name, value) => `# ${name}: ${value}\n`;
const bare = specimen.split("\n").filter((line) => !/^# (incidence_deg|specular)/.test(line)).join("\n");
// Each with another thing that a file decides; a fit by the emulator, rounded to four decimals, is that close.
const kinds = {
    "its own": specimen,
    "grazing, specular included": comment("incidence_deg", 60) + comment("specular", "included") + bare,
    "an instrument of ours": comment("instrument", "ncsu_45_0") + bare,
    "a broad band": comment("bandpass_shape", "gaussian") + comment("bandpass_width_nm", 30) + bare,
    "the printed edition": comment("edition", "printed") + bare,
};

for (const [kind, text] of Object.entries(kinds)) {
    onPage(`draws the model that the fit used, with the geometry of the file: ${kind}`, async (page) => {
        await drop(page, "arm.csv", text);
        await page.getByRole("button", {name: "Remove arm.csv"}).waitFor();
        await until(() => page.locator(".drawn-for").textContent(), (words) => /as the file says/.test(words), "the geometry of the file");
        if (text.includes("ncsu_45_0")) {  // sees light in a cone, which the solver alone knows
            await page.getByText("How it is fitted").click();
            await page.locator("#setting-engine").selectOption("solver");
        }
        await page.getByRole("button", {name: "Fit", exact: true}).click();
        await page.getByRole("table", {name: "Fitted values"}).waitFor({timeout: 120_000});
        await page.getByRole("button", {name: "sliders to fit 1"}).click();
        await until(() => difference(page, "model", "fit 1"), (found) => found <= 5e-4, "the curve of the fit");
        // Whatever has been done to the settings and the file since.
        await page.locator("input[value=printed]").check({force: true});
        await page.locator("input[value=revised]").check({force: true});
        await page.getByText("measurement", {exact: true}).click();
        await page.locator("#setting-incidence_deg").fill("20");
        await page.keyboard.press("Tab");
        await page.getByRole("button", {name: "Remove arm.csv"}).click();
        await until(() => page.url(), (url) => url.includes("incidence_deg=20"), "the link");
        await page.getByRole("button", {name: "sliders to fit 1"}).click();
        await until(() => difference(page, "model", "fit 1"), (found) => found <= 5e-4, "the curve of the fit again");
        assert.ok(!page.url().includes("incidence_deg"));
    });
}

onPage("shows the geometry it draws for, and who decides it", async (page) => {
    const drawnFor = page.locator(".drawn-for");
    assert.match(await drawnFor.textContent(), /incidence 8°, specular included.*by default/);
    await page.getByText("measurement", {exact: true}).click();
    assert.equal(await page.locator("#setting-incidence_deg").getAttribute("placeholder"), "8 (default)");
    await drop(page, "ncsu_113.csv", specimen);
    await until(() => drawnFor.textContent(), (text) => /incidence 45°, specular excluded \(as the file says\)/.test(text), "the geometry of the file");
    assert.match(await page.locator(".stated").textContent(), /incidence 45°, specular excluded/);
    assert.equal(await page.locator("#setting-incidence_deg").getAttribute("placeholder"), "45 (file)");
    assert.equal(await page.locator("#setting-specular option:checked").textContent(), "excluded (file)");
    await page.locator("#setting-incidence_deg").fill("30");
    await page.keyboard.press("Tab");
    await until(() => drawnFor.textContent(), (text) => /incidence 30° \(as set here\)/.test(text), "the geometry set here");
    await drop(page, "printed.csv", comment("edition", "printed") + specimen);
    await until(() => drawnFor.textContent(), (text) => /model 2: edition printed/.test(text), "a model for each edition");
    const [csv] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", {name: "CSV", exact: true}).click()]);
    assert.equal(csv.suggestedFilename(), "simulation_1.csv");
    await page.getByRole("button", {name: "Remove ncsu_113.csv"}).click();
    await until(() => page.locator("input[value=printed]").isChecked(), Boolean, "the edition of the file");
});

onPage("shows residuals below the curve, with the noise", async (page) => {
    assert.equal(await page.locator(".residuals").count(), 0);
    await fitSpecimen(page);
    await page.getByRole("button", {name: "sliders to fit 1"}).click();
    await until(() => difference(page, "model", "fit 1"), (found) => found <= 5e-4, "the curve of the fit");
    const {labels, rows} = await numbers(page, "The residuals in numbers");
    assert.deepEqual(labels.map((label) => label.slice(0, 16)), ["+1 sigma", "-1 sigma", "model − NCSU 113", "fit 1"]);
    const curves = await numbers(page);
    const [model, measured] = ["model", "NCSU 113"].map((label) => curves.labels.findIndex((each) => each.startsWith(label)));
    for (const {nm, values} of rows) {
        assert.deepEqual(values.slice(0, 2), [0.006, -0.006]);
        const at = curves.rows.find((row) => row.nm === nm).values;
        // Four decimals each; between the model's wavelengths it is interpolated.
        if (at[model] !== null) assert.ok(Math.abs(values[2] - (at[model] - at[measured])) <= 1.01e-4, `${nm} nm`);
        // Interpolation errs by less than a sixth of the noise.
        assert.ok(Math.abs(values[2] - values[3]) <= 1e-3, `${nm} nm`);
    }
    const [above, below] = await page.locator(".plot canvas, .residuals canvas").evaluateAll((all) => all.map((each) => each.getBoundingClientRect()));
    assert.ok(below.top >= above.bottom - 1 && below.height < above.height / 2);
});

onPage("takes a file that is dropped anywhere, and says so", async (page) => {
    for (const [k, onto] of ["body", "header", ".parameters", ".plot", "footer"].entries()) {
        await drop(page, `file_${k}.csv`, specimen, onto);
        await page.getByRole("button", {name: `Remove file_${k}.csv`}).waitFor();
    }
    const held = await page.evaluateHandle(() => {
        const transfer = new DataTransfer();
        transfer.items.add(new File(["a"], "a.csv"));
        return transfer;
    });
    await page.dispatchEvent("header", "dragover", {dataTransfer: held});
    await page.locator(".dropping").waitFor();
    await page.dispatchEvent("body", "dragleave", {dataTransfer: held});
    await page.locator(".dropping").waitFor({state: "detached"});
});

onPage("has a sample to begin with", async (page) => {
    await page.getByRole("button", {name: "Try a sample"}).click();
    await page.getByRole("button", {name: "Remove ncsu_113.csv"}).waitFor();
    await page.getByText(/^Explains NCSU 113/).waitFor();
});

onPage("refuses a cube with the command that reads it, and a file that is too large", async (page) => {
    const alert = page.getByRole("alert");
    for (const [name, text] of [["hand.hdr", "ENVI\nsamples = 2\n"], ["hand.img", "\u0001\u0000\u0002"], ["big.img", " ".repeat(17 * 2 ** 20)]]) {
        await drop(page, name, text);
        await until(() => alert.textContent(), (found) => found.startsWith(name), `what is wrong with ${name}`);
        assert.match(await alert.textContent(), /ENVI cube.*two files.*skinfit fit FILE/);
    }
    await drop(page, "big.csv", " ".repeat(17 * 2 ** 20));
    await until(() => alert.textContent(), (found) => /big\.csv: has 17\.0 MiB/.test(found), "that it is too large");
    assert.equal(await page.getByText("skinfit does not answer").count(), 0);
}, {complaints: true});

onPage("says in what two fits differ", async (page) => {
    await fitSpecimen(page);
    const differences = page.locator("tbody.differences");
    assert.equal(await differences.count(), 0);
    const fitAgain = async (count) => {
        await page.getByRole("button", {name: "Fit", exact: true}).click();
        await page.getByRole("columnheader", {name: `fit ${count}`}).waitFor({timeout: 120_000});
    };
    await fitAgain(2);
    assert.match(await differences.textContent(), /Nothing differs/);
    await page.getByRole("button", {name: "remove fit 2"}).click();
    await page.getByText("How it is fitted").click();
    await page.locator("#setting-wavelength_min_nm").fill("450");
    await page.locator("#setting-noise").fill("0.01");
    await page.getByRole("checkbox", {name: "fit bilirubin"}).uncheck();
    await number(page, "hemoglobin_g_per_l").fill("140");
    await page.keyboard.press("Tab");
    await page.getByRole("button", {name: "Remove ncsu_113.csv"}).click();
    await drop(page, "arm.csv", specimen.replace("NCSU 113", "my arm"));
    await fitAgain(3);
    const rows = Object.fromEntries(await differences.locator("tr:has(td)").evaluateAll(
        (all) => all.map((row) => [row.children[0].textContent, [...row.children].slice(1).map((cell) => cell.textContent)])));
    assert.deepEqual(rows["file"], ["ncsu_113.csv", "arm.csv"]);
    assert.deepEqual(rows["wavelength min (nm)"], ["400", "450"]);
    assert.deepEqual(rows["noise"], ["0.006", "0.01"]);
    assert.deepEqual(rows["free beside the others"], ["bilirubin g per l", "none"]);
    assert.deepEqual(rows["hemoglobin g per l, held"], ["150", "140"]);
    assert.match(rows["readings"][0], /^61, 400 to 700 nm$/);
    assert.match(rows["readings"][1], /^51, 450 to 700 nm$/);
    assert.ok("spectrum" in rows);
    assert.ok(!("incidence (°)" in rows) && !("engine" in rows));
});

onPage("offers no engine that cannot fit", async (page) => {
    await page.getByText("How it is fitted").click();
    assert.deepEqual(await page.locator("#setting-engine option").allTextContents(), ["paths", "solver", "emulator"]);
    await page.evaluate(() => { location.hash = "#engine=walk&scale=1.1"; });
    const alert = page.getByRole("alert");
    await alert.waitFor();
    assert.match(await alert.textContent(), /engine to "walk".*does not offer.*paths, solver and emulator/);
    assert.equal(await number(page, "scale").inputValue(), "1.1");
});

onPage("shows names of files as text, and writes out what is not to be seen", async (page) => {
    const name = "<img src=x onerror=alert(1)>";
    const hostile = `${name}\u202e\u001b[31m\nverdict: consistent`;
    const spectrum = JSON.stringify({name: hostile, wavelength_nm: [400, 450, 500, 550, 600, 650, 700], values: [0.1, 0.2, 0.3, 0.3, 0.4, 0.5, 0.5], unit: "fraction"});
    await drop(page, `<b>a</b>\u0007\u202e.json`, spectrum);
    await page.locator(".file").waitFor();
    await page.getByRole("button", {name: "Fit", exact: true}).click();
    await page.getByRole("table", {name: "Fitted values"}).waitFor({timeout: 120_000});
    const text = await page.locator("body").evaluate((body) => body.textContent);
    assert.ok(!/[\u0000-\u0008\u000b-\u001f\u007f-\u009f\u202a-\u202e]/.test(text), JSON.stringify(text.match(/.{9}[\u0000-\u0008\u000b-\u001f\u202e].{9}/)));
    assert.ok(text.includes(`${name}\\u202e\\x1b[31m\\nverdict: consistent`));
    assert.ok(text.includes("<b>a</b>\\x07\\u202e.json"));
    assert.equal(await page.locator("img, .file b, .comparison b, .u-legend b").count(), 0);
    await drop(page, "<i>bad</i>\u001b.txt", "dear diary\n");
    assert.match(await page.getByRole("alert").textContent(), /^<i>bad<\/i>\\x1b\.txt/);
    await page.evaluate(() => { location.hash = "#measured=" + encodeURIComponent("<u>b</u>\u202e.csv"); });
    await until(() => page.getByRole("alert").allTextContents(), (all) => all.some((each) => each.includes("<u>b</u>\\u202e.csv")), "the escaped name");
}, {complaints: true});

onPage("says on a phone that a table goes on to the right", async (page) => {
    await fitSpecimen(page);
    await page.getByRole("button", {name: "Fit", exact: true}).click();
    await page.getByRole("columnheader", {name: "fit 2"}).waitFor({timeout: 120_000});
    await page.setViewportSize({width: 390, height: 844});
    const box = page.locator(".fits .scrolling");
    await until(() => box.getAttribute("data-more"), (more) => more.includes("right"), "more to the right");
    const shade = () => box.evaluate((element) => getComputedStyle(element, "::after").opacity);
    assert.equal(await shade(), "1");
    assert.ok(await page.getByText("more to the right").isVisible());
    await box.locator(".scrolled").evaluate((element) => { element.scrollLeft = element.scrollWidth; });
    await until(() => box.getAttribute("data-more"), (more) => !more.includes("right") && more.includes("left"), "the end");
    assert.equal(await shade(), "0");
    assert.equal(await page.getByText("more to the right").count(), 0);
});

onPage("cancels a fit that would take hours", async (page) => {
    await drop(page, "ncsu_113.csv", specimen);
    await page.getByText("How it is fitted").click();
    await page.locator("#setting-engine").selectOption({label: "solver"});
    await page.locator("#setting-starts").fill("10000");
    await page.keyboard.press("Tab");
    await page.getByRole("button", {name: "Fit", exact: true}).click();
    await page.getByText(/searching/).waitFor({timeout: 60_000});
    await page.getByRole("button", {name: "Cancel fit 1"}).click();
    await until(() => news(page).textContent(), (text) => text === "fit 1 is cancelled", "the end of the fit");
});

onPage("exports what it shows", async (page) => {
    for (const [button, name, holds] of [["CSV", "simulation.csv", "wavelength_nm"], ["JSON", "simulation.json", "reflectance"],
        ["Configuration", "configuration.json", "melanosome_fraction"]]) {
        const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", {name: button, exact: true}).click()]);
        assert.equal(file.suggestedFilename(), name);
        assert.ok(readFileSync(await file.path(), "utf8").includes(holds));
    }
});

onPage("exports the report of a fit, a page that stands on its own", async (page) => {
    await fitSpecimen(page);
    const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", {name: "report of fit 1 as html"}).click()]);
    assert.equal(file.suggestedFilename(), "fit_1.html");
    const path = join(pictures, "fit_1.html");
    await file.saveAs(path);
    const text = readFileSync(path, "utf8");
    assert.ok(text.startsWith("<!DOCTYPE html>"));
    assert.ok(text.length < 2 * 1024 * 1024, `${text.length} bytes`);
    assert.ok(text.includes("ncsu_113.csv") && text.includes("skinfit explore"));
    assert.ok(!text.includes("<script"));
    const report = await page.context().newPage();
    try {
        const complaints = [];
        report.on("console", (message) => { if (message.type() === "error") complaints.push(message.text()); });
        report.on("request", (request) => { if (!/^(file|data):/.test(request.url())) complaints.push(request.url()); });
        await report.goto(`file://${path}`);
        assert.match(await report.locator(".badge").first().textContent(), /^(consistent|suspect)$/);
        const spectrum = report.getByRole("img", {name: /^Measured and modelled reflectance/});
        assert.ok(await spectrum.evaluate((image) => image.complete && image.naturalWidth > 100));
        // Its own style holds: the policy inside it allows that, and no other applies to a saved file.
        assert.equal(await report.locator(".badge").first().evaluate((badge) => getComputedStyle(badge).display), "inline-block");
        assert.deepEqual(complaints, []);
    } finally {
        await report.close();
    }
});

onPage("says what is wrong with a bad file", async (page) => {
    await drop(page, "notes.txt", "dear diary\n");
    await page.getByRole("alert").waitFor();
    assert.match(await page.getByRole("alert").textContent(), /notes\.txt/);
    await page.getByRole("button", {name: "Dismiss"}).click();
    await page.getByRole("alert").waitFor({state: "detached"});
}, {complaints: true});

test("says that the server has gone, in the middle of a fit", async () => {
    const own = await serve(join(source, "measurements/data/ncsu_113.csv"));
    const page = await openPage(browser.context, own.url);
    await page.getByText("How it is fitted").click();
    await page.locator("#setting-engine").selectOption({label: "solver"});
    await page.getByRole("button", {name: "Fit", exact: true}).click();
    await page.getByRole("button", {name: "Cancel fit 1"}).waitFor();
    await own.stop("SIGKILL");
    await page.getByText("skinfit does not answer").waitFor();
    await page.close();
});

test("ends at Ctrl-C, also while a fit runs, with exit code 0", async () => {
    const own = await serve(join(source, "measurements/data/ncsu_113.csv"));
    const page = await openPage(browser.context, own.url);
    await page.getByText("How it is fitted").click();
    await page.locator("#setting-engine").selectOption({label: "solver"});
    await page.getByRole("button", {name: "Fit", exact: true}).click();
    await page.getByText(/searching/).waitFor();
    assert.deepEqual(await own.stop("SIGINT"), {code: 0, signal: null});
    await page.close();
});

for (const scheme of ["light", "dark"]) {
    onPage(`has no accessibility violations and fits phones, ${scheme}`, async (page) => {
        await page.emulateMedia({colorScheme: scheme});
        await fitSpecimen(page);
        for (const width of [1280, 390]) {
            await page.setViewportSize({width, height: width === 390 ? 844 : 900});
            await page.evaluate(() => scrollTo(0, 0));
            await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
            const found = await page.evaluate(`${axe}; axe.run()`);
            assert.deepEqual(found.violations.map(({id, nodes}) => `${id}: ${nodes.map(({html}) => html).join(" ")}`), [], `at ${width}`);
            const {scrollWidth} = await page.evaluate(() => ({scrollWidth: document.scrollingElement.scrollWidth}));
            assert.ok(scrollWidth <= width, `${scrollWidth} pixels wide at ${width}`);
            await page.screenshot({path: join(pictures, `explore_${width}_${scheme}.png`)});
            await page.screenshot({path: join(pictures, `explore_${width}_${scheme}_full.png`), fullPage: true});
        }
    });
}

onPage("reports how long a curve takes to follow a slider", async (page, t) => {
    await slider(page, "melanosome_fraction").focus();
    const durations = () => page.evaluate(() => performance.getEntriesByName("slider-to-curve").map(({duration}) => duration));
    let times = await durations();
    for (let i = 0; i < 60; ++i) {  // one after the other: a slow machine draws fewer curves than there are moves
        const before = times.length;
        await page.keyboard.press(i % 40 < 20 ? "ArrowRight" : "ArrowLeft");
        times = await until(durations, (all) => all.length > before, "the next curve");
    }
    times.sort((a, b) => a - b);
    const at = (share) => times[Math.floor(share * (times.length - 1))].toFixed(1);
    t.diagnostic(`slider to curve: median ${at(0.5)} ms, 95th percentile ${at(0.95)} ms, of ${times.length} moves`);
    console.log(`slider to curve: median ${at(0.5)} ms, 95th percentile ${at(0.95)} ms, of ${times.length} moves`);
});
