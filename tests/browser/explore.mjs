// node explore.mjs PROGRAM SOURCE_FOLDER PICTURES_FOLDER
import assert from "node:assert/strict";
import {mkdirSync, readFileSync} from "node:fs";
import {join} from "node:path";
import {after, before, test} from "node:test";
import {browse, drop, hue, news, number, openPage, serve, skipWithoutBrowser, slider, source, until} from "./session.mjs";

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
    assert.equal(await page.locator(".numbers tbody tr").count(), 31);
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
    assert.ok(await page.locator("input[value=revised]").isChecked());
    await page.getByRole("button", {name: "Undo"}).click();
    assert.equal(await number(page, "melanosome_fraction").inputValue(), begin);
    await page.getByRole("button", {name: "Redo"}).click();
    await page.getByRole("button", {name: "Redo"}).click();
    await until(() => page.url(), (url) => url.includes("edition=printed"), "the link");
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
    assert.match(await alert.textContent(), /the measured file ncsu_113\.csv, which a link does not hold.*choose it under .Measured spectra., or drop it there/);
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
    assert.match(await news(page).textContent(), /^fit 1: (trustworthy|suspect)$/);
    await page.getByText("How it is fitted").click();
    await page.getByLabel("allow for the model").check();
    await page.getByRole("button", {name: "Fit", exact: true}).click();
    await page.getByRole("columnheader", {name: "fit 2"}).waitFor({timeout: 120_000});
    const row = page.getByRole("row", {name: /^melanosome fraction/});
    assert.match(await row.textContent(), /±.*±/);
    await page.getByRole("button", {name: "sliders to fit 1"}).click();
    assert.notEqual(await number(page, "melanosome_fraction").inputValue(), "0.052");
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
        assert.match(await report.locator(".badge").first().textContent(), /^(trustworthy|suspect)$/);
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
    for (let i = 0; i < 200; ++i) {
        await page.keyboard.press(i % 40 < 20 ? "ArrowRight" : "ArrowLeft");
        await page.waitForTimeout(30);
    }
    const times = await until(
        () => page.evaluate(() => performance.getEntriesByName("slider-to-curve").map(({duration}) => duration)),
        (all) => all.length > 150, "200 curves");
    times.sort((a, b) => a - b);
    const at = (share) => times[Math.floor(share * (times.length - 1))].toFixed(1);
    t.diagnostic(`slider to curve: median ${at(0.5)} ms, 95th percentile ${at(0.95)} ms, of ${times.length} moves`);
    console.log(`slider to curve: median ${at(0.5)} ms, 95th percentile ${at(0.95)} ms, of ${times.length} moves`);
});
