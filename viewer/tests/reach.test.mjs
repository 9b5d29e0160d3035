// The page of an arm's reach map.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { browse, changed, groebot, inFolder, open, page, picture, root } from "./page.mjs";

const UR5 = path.join(root, "derivations/ur5");
const GRID = ["--x", "-1:1:11", "--y", "-1:0.8:10", "--z", "-0.8:1:9"];
let browser, file, shown, map;
before(async () => {
  browser = await browse();
  groebot("reach", UR5, ...GRID, "--orientations", "6", "--measure", "manipulability", "-o", inFolder("map.json"), "--quiet");
  map = JSON.parse(readFileSync(inFolder("map.json"), "utf8"));
  file = page("reach.html", UR5, "--reach", inFolder("map.json"));
  shown = await open(browser, file);
});
after(() => browser?.close());

const QUANTITIES = {
  share: (place) => map.reached[place] / map.orientations,
  answers: (place) => map.answers[place] / map.orientations,
  // Single precision.
  manipulability: (place) => Math.fround(map.mean[place]),
};
const axes = () => [map.x, map.y, map.z];
const places = () => map.reached.length;

/** The number of a place by each axis, and where it is. */
function numbers(place) {
  const [, y, z] = axes().map(({ count }) => count);
  return [Math.floor(place / (y * z)), Math.floor(place / z) % y, place % z];
}
const at = (place) => numbers(place).map((number, axis) => {
  const { from, to, count } = axes()[axis];
  return count === 1 ? from : from + ((to - from) * number) / (count - 1);
});

/** How many places the map has that are to be shown, and the greatest value of the quantity. */
function expected({ quantity = "share", least = 0, last = [Infinity, Infinity, Infinity] }) {
  const value = QUANTITIES[quantity];
  const reached = [...map.reached.keys()].filter((place) => map.reached[place] > 0);
  const greatest = Math.max(...reached.map(value));
  const isIn = (place) => value(place) >= least * greatest && numbers(place).every((number, axis) => number <= last[axis]);
  return { count: reached.filter(isIn).length, greatest };
}

/** What the page shows; all of it at first, then what is asked for. */
const show = (opened, choice) => opened.evaluate((choice) => {
  groebot.reach.show({ quantity: "share", least: 0, upto: [Infinity, Infinity, Infinity], visible: true });
  groebot.reach.show(choice);
  return { count: groebot.reach.shown, greatest: groebot.reach.greatest };
}, choice);
const count = (opened) => opened.evaluate(() => groebot.reach.shown);
const words = (opened) => opened.locator("#reach-state").innerText();
const canvas = async (opened) => (await picture(opened), opened.locator("#canvas").screenshot());
/** Presses a key of a control, so often. */
async function press(opened, name, key, times = 1) {
  await opened.getByLabel(name, { exact: true }).focus();
  for (let time = 0; time < times; time++) await opened.keyboard.press(key);
}

test("as many places are shown as the map says, of each quantity", async () => {
  assert.equal(shown.failure, null);
  assert.ok(await shown.locator("#reach").isVisible());
  assert.equal(await shown.evaluate(() => groebot.reach.places), places());
  for (const quantity of Object.keys(QUANTITIES)) {
    for (const least of [0, 0.3, 0.71, 1]) assert.deepEqual(await show(shown, { quantity, least }), expected({ quantity, least }), `${quantity}, ${least}`);
  }
  await show(shown, {});
  const all = expected({}).count;
  assert.ok(all > 200 && all < places());
  assert.equal(await words(shown), `${all} of ${places()} places are reached, ${all} shown`);
  assert.ok(readFileSync(file).length < 2e6);
  assert.deepEqual([shown.requests, shown.complaints], [[], []]);
});

test("places tell what the map says of them", async () => {
  const asked = Array.from({ length: 300 }, (_, turn) => (turn * 7919) % places());
  // A point a third of a step from a grid point still has that grid point as the nearest one. Beyond the grid it is the
  // one at the border.
  const points = asked.map((place, turn) => at(place).map((value, axis) => value + ((turn + axis) % 2 ? 0.3 : -0.3) * ((axes()[axis].to - axes()[axis].from) / (axes()[axis].count - 1))));
  const found = await shown.evaluate((points) => points.map((point) => groebot.reach.at(...point)), points);
  asked.forEach((place, turn) => {
    const own = { reached: map.reached[place], answers: map.answers[place], share: map.reached[place] / map.orientations, manipulability: Math.fround(map.mean[place]) };
    assert.deepEqual(found[turn], own);
  });
  await assert.rejects(shown.evaluate(() => groebot.reach.at(0, NaN, 0)), /three finite numbers/);
});

test("the page's own solver reaches what the map says", async () => {
  const targets = Array.from({ length: 800 }, (_, turn) => {
    const [a, b, c] = [0.5497, 0.6710, 0.8192].map((step) => (turn * step) % 1);
    // Shoemake's uniform rotations.
    const [x, y, z, w] = [Math.sqrt(1 - a) * Math.sin(2 * Math.PI * b), Math.sqrt(1 - a) * Math.cos(2 * Math.PI * b), Math.sqrt(a) * Math.sin(2 * Math.PI * c), Math.sqrt(a) * Math.cos(2 * Math.PI * c)];
    const rotation = [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)];
    return [...at((turn * 7919) % places()), ...rotation];
  });
  const [told, found] = await shown.evaluate((targets) => targets.reduce(([told, found], target) => {
    groebot.drag("ur5", target);
    return [told + groebot.reach.at(...target.slice(0, 3)).share, found + (groebot.solutions().length > 0 ? 1 : 0)];
  }, [0, 0]), targets);
  // Six orientations at each point are a sample of all orientations.
  assert.ok(found > 100 && Math.abs(found / told - 1) < 0.1, `${found} of ${targets.length} are reached, ${told} are told`);
});

test("thresholds and borders take places out of the picture", async () => {
  const counts = [await show(shown, {}), await show(shown, { least: 0.5 }), await show(shown, { least: 0.9 })].map(({ count }) => count);
  assert.ok(counts[0] > counts[1] && counts[1] > counts[2], String(counts));
  await show(shown, {});
  const before = await canvas(shown);
  assert.ok(before.equals(await canvas(shown)), "at rest the picture stays");
  await show(shown, { least: 0.9 });
  assert.ok(!before.equals(await canvas(shown)), "fewer places are another picture");
  for (const axis of [0, 1, 2]) {
    for (const last of [0, 4, 7]) {
      const upto = [Infinity, Infinity, Infinity];
      upto[axis] = at(0)[axis] + ((axes()[axis].to - axes()[axis].from) * last) / (axes()[axis].count - 1);
      const borders = upto.map((value) => (value === Infinity ? Infinity : last));
      assert.deepEqual(await show(shown, { upto }), expected({ last: borders }), `axis ${axis}, ${last}`);
    }
  }
  await show(shown, {});
  assert.ok(before.equals(await canvas(shown)), "all of them are the first picture again");
  await show(shown, { quantity: "manipulability" });
  assert.ok(!before.equals(await canvas(shown)), "another quantity has other colours");
  await assert.rejects(shown.evaluate(() => groebot.reach.show({ least: 2 })), /share of the greatest/);
  await assert.rejects(shown.evaluate(() => groebot.reach.show({ quantity: "speed" })), /has no speed; it has share, answers, manipulability/);
  await assert.rejects(shown.evaluate(() => groebot.reach.show({ upto: [1, 2] })), /three numbers/);
  assert.deepEqual([shown.requests, shown.complaints], [[], []]);
});

test("the panel works by its keys", async () => {
  const { count: all } = await show(shown, {});
  const before = await canvas(shown);
  await press(shown, "Shown", "Space");
  assert.equal(await count(shown), 0);
  assert.match(await words(shown), /the map is hidden/);
  assert.ok(!before.equals(await canvas(shown)));
  await press(shown, "Shown", "Space");
  assert.equal(await count(shown), all);
  await press(shown, "At least", "ArrowRight", 40);
  assert.equal(await count(shown), expected({ least: 0.4 }).count);
  assert.match(await shown.getByLabel("At least", { exact: true }).getAttribute("aria-valuetext"), /^0\.\d{3}, 40 %$/);
  await press(shown, "x up to", "ArrowLeft", 5);
  await press(shown, "z up to", "ArrowLeft");
  assert.equal(await count(shown), expected({ least: 0.4, last: [5, Infinity, 7] }).count);
  assert.equal(await shown.getByLabel("x up to").getAttribute("aria-valuetext"), "0.000 m");
  await shown.getByLabel("Colour").selectOption("Answers per orientation");
  const { count: counted, greatest } = expected({ quantity: "answers", least: 0.4, last: [5, Infinity, 7] });
  assert.equal(await count(shown), counted);
  assert.ok((await shown.locator("#legend").innerText()).endsWith(greatest.toFixed(3)));
  assert.match(await shown.locator("#legend").getAttribute("aria-label"), /^Answers per orientation: from violet, 0, to yellow/);
  await shown.locator("#canvas").focus();
  await shown.keyboard.press("m");
  assert.ok(await shown.locator("#reach").isHidden());
  await shown.keyboard.press("m");
  assert.ok(await shown.locator("#reach").isVisible());
});

test("the map goes with its link", async () => {
  const ofTip = changed(file, "tip.html", (text) => text.replace(/("reach":\{"base":)\d+/, "$16"));
  for (const [own, isMoved] of [[file, false], [ofTip, true]]) {
    const opened = await open(browser, own);
    for (const name of ["Robot", "Axes"]) await opened.getByRole("button", { name, exact: true }).click();
    await opened.keyboard.press("j");
    await opened.locator("#joint-0").focus();
    const before = await canvas(opened);
    await opened.keyboard.press("ArrowRight");
    assert.equal(!before.equals(await canvas(opened)), isMoved);
  }
});

/** The colours of a map from least to greatest, those of groebot's own pictures. */
const COLOURS = [...readFileSync(path.join(root, "crates/ik/src/reach/drawing.rs"), "utf8").match(/COLOURS[^=]*= \[([\s\S]*?)\];/)[1].matchAll(/(\d+), (\d+), (\d+)/g)].map((found) => found.slice(1).map(Number));
function colour(share) {
  const first = Math.min(Math.floor(share * (COLOURS.length - 1)), COLOURS.length - 2);
  return COLOURS[first].map((from, part) => from + (COLOURS[first + 1][part] - from) * (share * (COLOURS.length - 1) - first));
}

/** The colours of points of what is seen. */
const pixels = async (opened, points) => opened.evaluate(async ([image, points]) => {
  const shot = new Image();
  shot.src = `data:image/png;base64,${image}`;
  await shot.decode();
  const seen = new OffscreenCanvas(shot.width, shot.height).getContext("2d");
  seen.drawImage(shot, 0, 0);
  return points.map(([x, y]) => [...seen.getImageData(Math.round(x), Math.round(y), 1, 1).data].slice(0, 3));
}, [(await picture(opened)).toString("base64"), points]);

test("a flat map is drawn where it is, in the colours of its legend", async () => {
  groebot("reach", UR5, "--x", "-1:1:9", "--y", "-1:1:9", "--z", "0.3", "--orientations", "4", "-o", inFolder("flat.json"), "--quiet");
  const flat = await open(browser, page("flat.html", UR5, "--reach", inFolder("flat.json")));
  assert.deepEqual(await flat.locator("#reach li label span").allInnerTexts(), ["At least", "x up to", "y up to"]);
  assert.equal(await flat.locator("#reach-quantity option").count(), 2);
  assert.equal(await flat.evaluate(() => groebot.reach.at(0.5, 0, 0).manipulability), undefined);
  const { reached, answers } = JSON.parse(readFileSync(inFolder("flat.json"), "utf8"));
  assert.equal(await count(flat), reached.filter((count) => count > 0).length);
  for (const name of ["Robot", "Axes"]) await flat.getByRole("button", { name, exact: true }).click();
  await flat.evaluate(() => groebot.reach.show({ quantity: "answers" }));
  const where = reached.map((_, place) => [-1 + Math.floor(place / 9) / 4, -1 + (place % 9) / 4, 0.3]);
  const points = await flat.getByRole("button", { name: "Top" }).evaluate((button, where) => {
    button.click();
    // Before the view is drawn.
    return where.map((point) => groebot.screen(point));
  }, where);
  const seen = await pixels(flat, points);
  const most = Math.max(...answers);
  seen.forEach((own, place) => {
    const off = Math.max(...colour(answers[place] / most).map((value, part) => Math.abs(value - own[part])));
    assert.equal(off < 4, reached[place] > 0, `place ${place} is ${own}`);
  });
});

test("a map of too many places is thinned out, and says so", async () => {
  const constant = (text) => text.replace(/"reach":\{.*?\}(?=,"wasm")/, '"reach":{"base":0,"of":"all","axes":[[-1,1,60],[-1,1,60],[-1,1,60]],"orientations":3,"limited":true,"reached":2,"answers":4}');
  const opened = await open(browser, changed(file, "many.html", constant));
  assert.equal(await count(opened), 216000);
  const [, drawn] = (await words(opened)).match(/216,000 shown, of which (\d+,\d+) evenly spread ones are drawn/);
  assert.ok(Math.abs(Number(drawn.replace(",", "")) - 99000) < 1000, drawn);
  assert.match(await opened.locator("#reach-of").innerText(), /^all; 3 orientations at each place, answers within limits$/);
  await opened.evaluate(() => groebot.reach.show({ upto: [0, 1, 1] }));
  assert.equal(await words(opened), "216,000 of 216,000 places are reached, 108,000 shown, of which " + (await words(opened)).match(/which (\S+)/)[1] + " evenly spread ones are drawn");
  await opened.evaluate(() => groebot.reach.show({ upto: [-0.5, 1, 1] }));
  assert.equal(await words(opened), "216,000 of 216,000 places are reached, 54,000 shown");
});

test("without a map there is no panel; without WebGL its numbers stand", async () => {
  const bare = await open(browser, page("bare.html", UR5));
  assert.equal(await bare.evaluate(() => groebot.reach), null);
  assert.ok(await bare.locator("#reach-button").isHidden());
  await bare.keyboard.press("m");
  assert.ok(await bare.locator("#reach").isHidden());
  const blind = await browse({ webgl: false });
  const plain = await open(blind, file);
  await press(plain, "At least", "End");
  assert.equal(await count(plain), expected({ least: 1 }).count);
  assert.deepEqual(plain.requests, []);
  await blind.close();
});

test("a phone shows the panel below the picture, in both themes", async () => {
  for (const colorScheme of ["light", "dark"]) {
    const phone = await open(browser, file, { viewport: { width: 390, height: 844 }, hasTouch: true, colorScheme });
    assert.ok(await phone.evaluate(() => document.documentElement.scrollWidth <= innerWidth && document.getElementById("reach").scrollWidth <= innerWidth));
    assert.ok((await phone.locator("#reach").boundingBox()).y > 300);
    assert.deepEqual(phone.complaints, []);
  }
});

const BROKEN = [
  ["cut", (text) => text.replace(/"reached":"[^"]{16}/, '"reached":"'), /damaged/],
  ["of another grid", (text) => text.replace(/("axes":\[\[-?[\d.]+,[\d.]+,)11/, "$112"), /damaged: a column of the reach map has 990 of 1080 places/],
  ["with an axis from right to left", (text) => text.replace(/"axes":\[\[-1(\.0)?,/, '"axes":[[2,'), /damaged: the reach map has an invalid axis/],
  ["at a link that is not there", (text) => text.replace(/("reach":\{"base":)\d+/, "$1777"), /damaged: the reach map starts at a link that does not exist/],
  ["with more reached than asked", (text) => text.replace('"orientations":6', '"orientations":2'), /damaged: the reach map has invalid counts/],
  ["with no orientations", (text) => text.replace('"orientations":6', '"orientations":0'), /damaged: the reach map has no orientations/],
  ["of too many places", (text) => text.replace(/"axes":\[\[.*?\]\]/, '"axes":[[0,1,1000],[0,1,1000],[0,1,1000]]'), /damaged: the reach map has 1000000000 places/],
];

test("a broken map is told", async () => {
  for (const [what, change, reason] of BROKEN) {
    const opened = await open(browser, changed(file, "broken.html", change));
    assert.match(opened.failure ?? "", reason, what);
    assert.match(await opened.locator("#message").innerText(), reason, what);
    assert.deepEqual(opened.complaints, [], what);
    await opened.context().close();
  }
});
