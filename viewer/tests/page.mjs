// Pages of groebot, opened in Debian's Chromium with all network requests refused.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { afterEach, beforeEach } from "node:test";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

export const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");
export const program = process.env.GROEBOT ?? path.join(root, "target/debug/groebot");
const ARGUMENTS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
  "--disable-sync", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
];
const WITHOUT_WEBGL = [...ARGUMENTS.filter((each) => !each.includes("swiftshader")), "--disable-3d-apis"];

/** A folder for the pages of a test file, removed at its end. */
export const folder = mkdtempSync(path.join(tmpdir(), "groebot-viewer-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));

export const inFolder = (name) => path.join(folder, name);
export const groebot = (...given) => execFileSync(program, given, { encoding: "utf8", maxBuffer: 1 << 28 });

/** Writes a page; its file. */
export function page(name, ...given) {
  const file = inFolder(name);
  groebot("view", ...given, "-o", file);
  return file;
}

/** The page of a file with a part of its text changed. */
export function changed(file, name, change) {
  const before = readFileSync(file, "utf8");
  const after = change(before);
  if (after === before) throw new Error("nothing was changed");
  writeFileSync(inFolder(name), after);
  return inFolder(name);
}

export const browse = ({ webgl = true } = {}) =>
  chromium.launch({ executablePath: "/usr/bin/chromium", args: webgl ? ARGUMENTS : WITHOUT_WEBGL });

// An open page continues to play and slows down the next test. Pages opened by `before` are shared by all tests of a file.
let contexts = [];
beforeEach(() => void (contexts = []));
afterEach(() => Promise.all(contexts.map((context) => context.close())));

/** Opens a file, until the test ends; what it asked for and complained about stands in `requests` and `complaints`. */
export async function open(browser, file, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, ...options });
  contexts.push(context);
  const opened = await context.newPage();
  const [requests, complaints] = [[], []];
  await context.route(/.*/, (route) => {
    const asked = route.request().url();
    if (asked === `file://${file}`) return route.continue();
    requests.push(asked);
    return route.abort();
  });
  opened.on("console", (message) => {
    // Chromium prints a message for screenshots with software rendering.
    if (message.type() !== "log" && !message.text().includes("ReadPixels")) complaints.push(message.text());
  });
  opened.on("pageerror", (error) => complaints.push(error.message));
  await opened.goto(`file://${file}`);
  const failure = await opened.evaluate(() => window.groebot.ready.then(() => null, (error) => error.message));
  return Object.assign(opened, { requests, complaints, failure });
}

/** A picture once all that was asked for has been drawn. */
export async function picture(opened) {
  await opened.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done)))));
  return opened.screenshot();
}

/** The rows of a trajectory's CSV, by the names of their columns without units. */
export function rows(file) {
  const [names, ...lines] = readFileSync(file, "utf8").split("\n").filter((line) => line && !line.startsWith("#"));
  const columns = names.split(",").map((name) => name.replace(/ \[.*\]$/, ""));
  return lines.map((line) => Object.fromEntries(line.split(",").map((cell, place) => [columns[place], Number(cell)])));
}
