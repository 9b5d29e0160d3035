// Draws docs/readme.png from two pages of `groebot view`: README.md in this folder.
import { writeFileSync } from "node:fs";
import path from "node:path";
import { browse, groebot, inFolder, open, page, root } from "../../viewer/tests/page.mjs";

/** Width of one half and height of the picture, in pixels of the page. */
const [WIDTH, HEIGHT] = [480, 380];
/** Pixels of the picture for each pixel of the page. */
const SCALE = 1.25;
/** A pose that a UR5 reaches with eight joint configurations: position [m], then the rotation by rows. */
const TARGET = [-0.42, -0.25, 0.32, 0.6, 0, 0.8, 0, 1, 0, -0.8, 0, 0.6];
/** A moment of the walk in which one foot swings [s]. */
const TIME = 4.95;

/** Only the canvas remains of a page. */
const BARE = `
  header, aside, footer, #layers, #notes, #message { display: none !important; }
  body { display: block !important; }
  #stage { position: fixed !important; inset: 0; width: 100vw; height: 100vh; }`;

/** A part of the canvas of a page as PNG: the size of the page and the upper left corner of the part. */
async function half(browser, file, [width, height], [x, y], act) {
  const opened = await open(browser, file, { viewport: { width, height }, deviceScaleFactor: SCALE });
  await opened.addStyleTag({ content: BARE });
  await act(opened);
  await opened.waitForTimeout(500);
  return opened.screenshot({ clip: { x, y, width: WIDTH, height: HEIGHT } });
}

const arm = page("ur5.html", path.join(root, "derivations/ur5"));
groebot("walk", "nao", "--steps", "8", "-o", inFolder("walk.json"), "--quiet");
const walk = page("walk.html", inFolder("walk.json"));

const browser = await browse();
const halves = [
  await half(browser, arm, [590, 490], [60, 12], (opened) => opened.evaluate((target) => window.groebot.drag("ur5", target), TARGET)),
  await half(browser, walk, [700, 583], [180, 104], (opened) => opened.evaluate((time) => window.groebot.seek(time), TIME)),
];
const image = (bytes) => `<img src="data:image/png;base64,${bytes.toString("base64")}" width="${WIDTH}" height="${HEIGHT}">`;
const file = inFolder("both.html");
writeFileSync(file, `<body style="margin: 0; display: flex">${halves.map(image).join("")}</body>`);
const both = await (await browser.newContext({ viewport: { width: 2 * WIDTH, height: HEIGHT }, deviceScaleFactor: SCALE })).newPage();
await both.goto(`file://${file}`);
await both.screenshot({ path: process.argv[2] ?? path.join(root, "docs/readme.png") });
await browser.close();
