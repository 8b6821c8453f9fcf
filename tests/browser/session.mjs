// A server of its own and a browser that looks at it.
import {spawn} from "node:child_process";
import {existsSync, mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {createInterface} from "node:readline";
import {chromium} from "playwright-core";

const browserPath = "/usr/bin/chromium";
export const program = process.argv[2];
export const source = process.argv[3];

/// Ends the run with the code that ctest takes for a skipped test.
export function skipWithoutBrowser() {
    if (existsSync(browserPath)) return;
    console.log(`skipped: there is no ${browserPath}; ./quickstart test installs it`);
    process.exit(77);
}

/// A running `skinfit explore` with a cache of its own.
export async function serve(...options) {
    const cache = mkdtempSync(join(tmpdir(), "skinfit_browser_"));
    const server = spawn(program, ["explore", ...options], {env: {...process.env, SKINFIT_CACHE_DIR: cache}, stdio: ["ignore", "pipe", "pipe"]});
    const ended = new Promise((resolve) => server.on("exit", (code, signal) => resolve({code, signal})));
    let complaint = "";
    server.stderr.on("data", (text) => { complaint += text; });
    const url = await Promise.race([
        new Promise((resolve) => createInterface({input: server.stdout}).once("line", resolve)),
        ended.then(() => { throw new Error(`skinfit explore ended: ${complaint}`); }),
    ]);
    const stop = async (signal = "SIGINT") => {
        server.kill(signal);
        const how = await ended;
        rmSync(cache, {recursive: true, force: true});
        return how;
    };
    return {url, stop};
}

export async function browse() {
    const profile = mkdtempSync(join(tmpdir(), "skinfit_chromium_"));
    const context = await chromium.launchPersistentContext(profile, {
        executablePath: browserPath,
        headless: true,
        args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
            "--disable-component-update", "--disable-sync"],
        viewport: {width: 1280, height: 900},
    });
    const close = async () => {
        await context.close();
        rmSync(profile, {recursive: true, force: true});
    };
    return {context, close};
}

/// The page of a server, once its first curve is drawn. What the browser complains of, and what it asks of others, is
/// collected.
export async function openPage(context, url) {
    const page = await context.newPage();
    page.complaints = [];
    page.foreign = [];
    page.on("pageerror", (error) => page.complaints.push(String(error)));
    page.on("console", (message) => { if (message.type() === "error") page.complaints.push(message.text()); });
    page.on("request", (request) => {
        const address = new URL(request.url());
        if (address.protocol.startsWith("http") && address.origin !== new URL(url).origin) page.foreign.push(request.url());
    });
    await page.goto(url);
    await page.waitForSelector(".plot canvas");
    return page;
}

export const slider = (page, parameter) => page.locator(`[data-parameter="${parameter}"] input[type=range]`);
export const number = (page, parameter) => page.locator(`#number-${parameter}`);
export const hue = (page) => page.locator(".swatch [role=img]").getAttribute("aria-label");
export const news = (page) => page.locator("[role=status]");

/// Waits until `look` gives something that passes.
export async function until(look, passes, what) {
    const begin = Date.now();
    for (;;) {
        const found = await look();
        if (passes(found)) return found;
        if (Date.now() - begin > 60_000) throw new Error(`${what} never came; last seen: ${JSON.stringify(found)}`);
        await new Promise((resolve) => setTimeout(resolve, 20));
    }
}

/// The numbers under a plot: the labels of its curves, and of each wavelength the value of each.
export async function numbers(page, summary = "The same in numbers") {
    const box = page.locator("details.numbers", {hasText: summary});
    const labels = (await box.locator("thead th").allTextContents()).slice(1);
    const rows = await box.locator("tbody tr").evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
    return {labels, rows: rows.map(([nm, ...values]) => ({nm: Number(nm), values: values.map((value) => (value === "–" ? null : Number(value)))}))};
}

/// Drops text as a file upon what `onto` selects; a browser gives the file to the page at that place.
export async function drop(page, name, text, onto = "main") {
    const data = await page.evaluateHandle(([file, content]) => {
        const transfer = new DataTransfer();
        transfer.items.add(new File([content], file));
        return transfer;
    }, [name, text]);
    await page.dispatchEvent(onto, "drop", {dataTransfer: data});
}
