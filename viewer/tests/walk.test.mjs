// A walk in the page: its numbers are compared with the CSV and the robot's URDF, and user actions are tested.
import assert from "node:assert/strict";
import { statSync, writeFileSync } from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { browse, groebot, inFolder, open, page, picture, root, rows } from "./page.mjs";
import { apart, joints, links } from "./urdf.mjs";

const POSE = ["x", "y", "z", "qx", "qy", "qz", "qw"];
let browser, csv, json, table, all;

before(async () => {
  browser = await browse();
  csv = inFolder("walk.csv");
  const record = inFolder("walk.json");
  for (const file of [csv, record]) groebot("walk", "nao", "--steps", "4", "--turn", "10", "-o", file, "--quiet");
  groebot("export", "nao_v5", "--format", "urdf", "-o", inFolder("nao.urdf"));
  [table, all] = [rows(csv), joints(inFolder("nao.urdf"))];
  [csv, json] = [page("csv.html", csv), page("json.html", record)];
});
after(() => browser?.close());

const close = (a, b, within) => assert.ok(Math.abs(a - b) <= within, `${a} is not ${b}`);
const time = (opened) => opened.evaluate(() => window.groebot.time);

test("the page opens, asks nobody, complains of nothing, and is small", async () => {
  for (const file of [csv, json]) {
    assert.ok(statSync(file).size <= 2_000_000, `${statSync(file).size} bytes`);
    const opened = await open(browser, file);
    // The time from the start of loading to the first picture is printed only: other programs may delay it.
    const shown = await opened.evaluate(() => performance.now());
    assert.deepEqual([opened.failure, opened.requests, opened.complaints], [null, [], []]);
    await opened.context().close();
    console.log(`${statSync(file).size} bytes, shown after ${Math.round(shown)} ms`);
  }
});

test("scrubbing brings the pose of the table's row", async () => {
  const opened = await open(browser, csv);
  const samples = Array.from({ length: 25 }, (_, place) => Math.round((place * (table.length - 1)) / 24));
  for (const sample of samples) {
    await opened.locator("#scrub").fill(String(sample));
    const [pose, now, zmp, margin] = await opened.evaluate(() => [groebot.pose(), groebot.time, groebot.zmp(), groebot.margin()]);
    const row = table[sample];
    assert.equal(now, row.time);
    for (const [name, value] of Object.entries(row)) if (name.startsWith("q:")) close(pose.joints[name.slice(2)], value, 1e-9);
    POSE.forEach((end, place) => close(pose.base[place], row[`base_${end}`], 1e-9));
    ["x", "y", "z"].forEach((end, place) => close(zmp[place], row[`zmp_${end}`], 1e-9));
    close(margin, row.margin, 1e-9);

    const values = Object.fromEntries(Object.entries(row).flatMap(([name, value]) => (name.startsWith("q:") ? [[name.slice(2), value]] : [])));
    const expected = links(all, values, POSE.map((end) => row[`base_${end}`]));
    const off = apart(pose.links, expected);
    assert.ok(off < 1e-9, `sample ${sample}: links are ${off} off`);
    // The feet in the table, to its nine decimals.
    for (const side of ["left", "right"]) {
      ["x", "y", "z"].forEach((end, place) => close(pose.links[`${side[0]}_sole`][4 * place + 3], row[`${side}_${end}`], 2e-8));
    }
  }
  assert.deepEqual(opened.complaints, []);
});

test("a time is held within the motion, and lies on the line between two samples", async () => {
  const opened = await open(browser, csv);
  const at = (asked) => opened.evaluate((asked) => (groebot.seek(asked), [groebot.time, groebot.pose().joints.LKneePitch]), asked);
  const last = table.at(-1);
  assert.deepEqual([await at(-1), await at(1e9)], [[0, table[0]["q:LKneePitch"]], [last.time, last["q:LKneePitch"]]]);
  const [a, b] = [table[200], table[201]];
  const [now, value] = await at(a.time + 0.25 * (b.time - a.time));
  close(now, a.time + 0.25 * (b.time - a.time), 1e-12);
  close(value, 0.75 * a["q:LKneePitch"] + 0.25 * b["q:LKneePitch"], 1e-9);
});

test("a base may be turned in any way", async () => {
  const names = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"];
  const ur5 = path.join(root, "tests/corpus/urdf/ur5.urdf");
  const arm = joints(ur5);
  assert.deepEqual(arm.filter(({ type }) => type === "revolute").map(({ name }) => name), names);
  const lines = Array.from({ length: 7 }, (_, sample) => {
    const wave = (place) => Math.sin(1.3 * sample + 2.1 * place);
    const quaternion = [0, 1, 2, 3].map(wave);
    // A quaternion and its negative are the same rotation. Every second one is replaced by its negative.
    const length = Math.hypot(...quaternion);
    return [0.1 * sample, ...names.map((_, place) => 2 * wave(place + 5)), wave(11), wave(12), wave(13), ...quaternion.map((x) => (sample % 2 ? -x : x) / length)];
  });
  const head = `time [s],${names.map((name) => `q:${name} [rad]`)},${POSE.map((end) => `base_${end} [${end.startsWith("q") ? 1 : "m"}]`)}`;
  writeFileSync(inFolder("tumble.csv"), `# groebot trajectory 1\n# robot: ur5\n${head}\n${lines.map((line) => line.join()).join("\n")}\n`);
  const opened = await open(browser, page("tumble.html", inFolder("tumble.csv"), "--robot", ur5));
  for (const row of rows(inFolder("tumble.csv"))) {
    const pose = await opened.evaluate((time) => (groebot.seek(time), groebot.pose()), row.time);
    const off = apart(pose.links, links(arm, Object.fromEntries(names.map((name) => [name, row[`q:${name}`]])), POSE.map((end) => row[`base_${end}`])));
    assert.ok(off < 1e-9, `links are ${off} off`);
  }
  // At the midpoint of two samples the quaternion is their normalised sum, with equal signs.
  const [a, b] = lines.slice(2, 4).map((line) => line.slice(-4));
  const sign = a.reduce((sum, x, place) => sum + x * b[place], 0) < 0 ? -1 : 1;
  const sum = a.map((x, place) => x + sign * b[place]);
  const between = await opened.evaluate((time) => (groebot.seek(time), groebot.pose().base), 0.5 * (lines[2][0] + lines[3][0]));
  sum.forEach((x, place) => close(between[3 + place], x / Math.hypot(...sum), 1e-9));
});

test("keys play, step and jump", async () => {
  const opened = await open(browser, csv);
  const { keyboard } = opened;
  const press = async (key) => (await keyboard.press(key), time(opened));
  assert.equal(await press("ArrowRight"), table[1].time);
  assert.equal(await press("Shift+ArrowRight"), table[11].time);
  assert.equal(await press("ArrowLeft"), table[10].time);
  assert.equal(await press("End"), table.at(-1).time);
  assert.equal(await press("Home"), table[0].time);
  await keyboard.press("Space");
  await opened.waitForFunction(() => groebot.time > 0.2);
  assert.equal(await opened.locator("#play").getAttribute("aria-label"), "Pause");
  const stopped = await press("Space");
  await opened.waitForTimeout(100);
  assert.equal(await time(opened), stopped);
  await keyboard.press("?");
  assert.ok(await opened.locator("#help").isVisible());
  await keyboard.press("Escape");
  assert.ok(!(await opened.locator("#help").isVisible()));
  await keyboard.press("j");
  assert.ok(await opened.getByText("LKneePitch").isVisible());
  assert.ok(await opened.locator("#joints input").first().isDisabled());
});

test("it plays to its end at the speed that is chosen, and from the start again", async () => {
  const opened = await open(browser, csv);
  await opened.locator("#speed").selectOption("4");
  await opened.locator("#play").click();
  await opened.waitForFunction((end) => groebot.time === end, table.at(-1).time);
  assert.equal(await opened.locator("#play").getAttribute("aria-label"), "Play");
  await opened.locator("#play").click();
  await opened.waitForFunction((end) => groebot.time < end, table.at(-1).time);
});

test("presets, layers, time and theme change the picture", async () => {
  const opened = await open(browser, json);
  await opened.evaluate(() => groebot.seek(3));
  const seen = [await picture(opened)];
  const differs = async (what) => {
    const now = await picture(opened);
    assert.ok(seen.every((before) => !before.equals(now)), `${what} changes nothing`);
    seen.push(now);
  };
  for (const key of ["1", "2", "3", "4"]) {
    await opened.keyboard.press(key);
    await differs(`key ${key}`);
  }
  await opened.getByRole("button", { name: "Follow" }).click();
  for (const layer of ["Robot", "Support polygon", "Footsteps", "Soles", "Centre of mass", "ZMP", "Pendulum ZMP", "Axes"]) {
    await opened.getByRole("button", { name: layer, exact: true }).click();
    await differs(layer);
  }
  await opened.keyboard.press("t");
  await differs("the theme");
  await opened.mouse.move(600, 250);
  await opened.mouse.down();
  await opened.mouse.move(700, 280);
  await opened.mouse.up();
  await differs("dragging");
  await opened.evaluate(() => groebot.seek(5));
  await differs("time");
  assert.deepEqual(opened.complaints, []);
});

test("dark and light follow the system until they are switched", async () => {
  const ground = (opened) => opened.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const [light, dark] = [await open(browser, csv, { colorScheme: "light" }), await open(browser, csv, { colorScheme: "dark" })];
  const [bright, dim] = [await ground(light), await ground(dark)];
  assert.notEqual(bright, dim);
  await light.emulateMedia({ colorScheme: "dark" });
  // Pages receive the system's theme change with a delay.
  await light.waitForFunction((dim) => getComputedStyle(document.body).backgroundColor === dim, dim);
  await light.getByRole("button", { name: "Dark or light" }).click();
  assert.equal(await ground(light), bright);
});

test("what is seen is said", async () => {
  const opened = await open(browser, json);
  assert.match(await opened.locator("#canvas").getAttribute("aria-label"), /nao_v5.*24 joints.*seconds/);
  const sample = 300;
  await opened.locator("#scrub").fill(String(sample));
  const [{ time: now, margin }, live] = [table[sample], opened.locator("#live")];
  await opened.waitForFunction((text) => document.getElementById("live").textContent.includes(text), `${now.toFixed(2)} seconds`);
  const said = await live.textContent();
  assert.match(said, /step \d/);
  assert.ok(said.includes(`margin ${(1000 * margin).toFixed(1)} mm`), said);
  const nameless = await opened.evaluate(() =>
    [...document.querySelectorAll("button, input, select, canvas")].filter(
      (each) => !(each.getAttribute("aria-label") || each.labels?.length || each.textContent.trim()),
    ).length,
  );
  assert.equal(nameless, 0);
});

test("lanes scrub by mouse, and on a phone by touch; nothing sticks out", async () => {
  const opened = await open(browser, json);
  const middle = async (page) => {
    const { x, y, width, height } = await page.locator("#lanes canvas").last().boundingBox();
    return [x + width / 2, y + height / 2];
  };
  await opened.mouse.click(...(await middle(opened)));
  close(await time(opened), table.at(-1).time / 2, 0.05);

  const phone = await open(browser, json, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
  assert.equal(await phone.evaluate(() => document.documentElement.scrollWidth), 390);
  for (const each of await phone.locator("button:visible, select:visible, #lanes canvas").all()) {
    const { x, y, width, height } = await each.boundingBox();
    assert.ok(x >= 0 && y >= 0 && x + width <= 390 && y + height <= 844, await each.evaluate((node) => node.outerHTML));
  }
  await phone.touchscreen.tap(...(await middle(phone)));
  close(await time(phone), table.at(-1).time / 2, 0.1);
  assert.deepEqual(phone.complaints, []);
});
