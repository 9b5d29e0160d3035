// A robot that walks through a room while its goal, the furniture and the gait parameters change.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { browse, inFolder, open, page, picture, rows } from "./page.mjs";

const NAMES = ["Lp", "Hp", "Wp", "Gcm", "Hcm", "Kcm", "RAas", "Pocm", "Ca"];
const ROOM = `size = [4.0, 2.6]
wall = 0.05
[[furniture]]
name = "box"
box = [0.3, 0.3]
at = [3.6, 0.4]
height = 0.4
`;
let browser, file;
before(async () => {
  browser = await browse();
  writeFileSync(inFolder("room.toml"), ROOM);
  file = page("room.html", "rh0", "--room", inFolder("room.toml"), "--start", "0.6,1.2", "--goal", "3,1.2");
});
after(() => browser?.close());

const middle = (opened) => opened.evaluate(() => groebot.pose().base.slice(0, 2));
const text = (opened) => opened.locator("#run-state").innerText();

test("goal, furniture and figures change, and the next step obeys", async () => {
  const opened = await open(browser, file);
  const told = await opened.evaluate(() => groebot.parameters);
  assert.deepEqual(Object.keys(told), NAMES);
  assert.deepEqual([told.Lp, told.Hp, told.Gcm.toFixed(9)], [0.16, 0.1, "15.000000000"]);
  for (let step = 0; step < 3; step++) assert.equal(await opened.evaluate(() => groebot.step()), "step");
  const straight = await opened.evaluate(() => groebot.path());
  assert.ok(straight.every(([, y]) => Math.abs(y - 1.2) < 1e-9));
  const spent = await opened.evaluate(() => {
    groebot.furniture("box", [2, 1.2, 0.3]);
    return groebot.replan_ms;
  });
  console.log(`replanned in ${spent.toFixed(1)} ms`);
  assert.ok((await opened.evaluate(() => groebot.path())).length > 2);
  await opened.evaluate(() => {
    groebot.set("Lp", 0.08);
    groebot.set("Hp", 0.05);
    groebot.goal(0.9, 2);
  });
  const [steps, longest] = await opened.evaluate(() => {
    let [count, most, last] = [0, 0, groebot.pose().base];
    while (groebot.step() !== "arrived") {
      groebot.seek(1e9);
      const { base } = groebot.pose();
      if (count > 1) most = Math.max(most, Math.hypot(base[0] - last[0], base[1] - last[1]));
      [count, last] = [count + 1, base];
    }
    groebot.seek(1e9);
    return [count, most];
  });
  const [x, y] = await middle(opened);
  assert.ok(steps > 8 && Math.hypot(x - 0.9, y - 2) < 0.02, `it stands at ${x}, ${y}`);
  assert.ok(longest < 0.15, `a step of ${longest} m`);
  assert.match(await text(opened), /has reached the goal/);
  const least = await opened.evaluate(() => Math.min(...[...Array(200).keys()].map((k) => (groebot.seek((k * groebot.time) / 200), groebot.margin()))));
  assert.ok(least >= 0);
  assert.deepEqual([opened.requests, opened.complaints], [[], []]);
});

test("what cannot be is refused with its reason, and all stays as it was", async () => {
  const opened = await open(browser, file);
  const before = await opened.evaluate(() => [groebot.parameters, groebot.path()]);
  await assert.rejects(opened.evaluate(() => groebot.set("Hcm", 0.9)), /out of reach/);
  await assert.rejects(opened.evaluate(() => groebot.set("Hq", 0.9)), /did you mean/);
  await assert.rejects(opened.evaluate(() => groebot.goal(3.6, 0.4)), /the nearest free place/);
  await assert.rejects(opened.evaluate(() => groebot.furniture("box", [0.6, 1.2, 0])), /would overlap the robot/);
  await assert.rejects(opened.evaluate(() => groebot.furniture("piano", null)), /no piece `piano`/);
  assert.deepEqual(await opened.evaluate(() => [groebot.parameters, groebot.path()]), before);
  const field = opened.getByLabel(/^Hcm/);
  const own = await field.inputValue();
  await field.fill("0.9");
  await field.press("Enter");
  assert.match(await text(opened), /out of reach/);
  assert.equal(await field.inputValue(), own);
});

test("the panel steps, takes presets, and moves goal and furniture by keyboard and mouse", async () => {
  const opened = await open(browser, file);
  await opened.getByRole("button", { name: "Step", exact: true }).click();
  assert.match(await text(opened), /1 steps/);
  await opened.getByLabel("Figures of the thesis").selectOption("6.2.2 turn, experiment");
  const { Gcm, Ca } = await opened.evaluate(() => groebot.parameters);
  assert.deepEqual([Gcm, Ca], [10, 0.043]);
  await opened.getByLabel("Figures of the thesis").selectOption("5.5 whole task");
  assert.equal((await opened.evaluate(() => groebot.parameters)).Ca, 0.3429);
  await opened.getByLabel("Goal or furniture").selectOption("goal");
  const x = opened.locator("#place input").first();
  await x.fill("2.5");
  await x.press("Enter");
  assert.deepEqual((await opened.evaluate(() => groebot.path())).at(-1), [2.5, 1.2]);
  await opened.getByRole("button", { name: "Top" }).click();
  await picture(opened);
  const place = (at) => opened.evaluate((point) => groebot.screen(point), at);
  const [from, to] = [await place([2.5, 1.2, 0]), await place([2.4, 0.8, 0])];
  await opened.mouse.move(...from);
  await opened.mouse.down();
  await opened.mouse.move(...to, { steps: 4 });
  await opened.mouse.up();
  const end = (await opened.evaluate(() => groebot.path())).at(-1);
  assert.ok(Math.hypot(end[0] - 2.4, end[1] - 0.8) < 0.02, `the goal is at ${end}`);
  assert.deepEqual(opened.complaints, []);
});

test("it walks while it plays, and what it walked is read back", async () => {
  const opened = await open(browser, file);
  await opened.getByLabel("Speed", { exact: true }).selectOption("4");
  await opened.locator("#canvas").focus();
  await opened.keyboard.press("Space");
  await opened.waitForFunction(() => groebot.time > 8, null, { timeout: 60000 });
  await opened.keyboard.press("Space");
  const csv = await opened.evaluate(() => groebot.csv());
  writeFileSync(inFolder("walked.csv"), csv);
  const read = await open(browser, page("walked.html", inFolder("walked.csv")));
  const all = rows(inFolder("walked.csv"));
  const time = all[Math.floor(all.length / 2)].time;
  const [own, other] = [opened, read].map((each) => each.evaluate((at) => (groebot.seek(at), groebot.pose().joints), time));
  for (const [joint, value] of Object.entries(await own)) assert.ok(Math.abs(value - (await other)[joint]) < 1e-8);
  assert.ok(readFileSync(inFolder("walked.csv"), "utf8").startsWith("# groebot trajectory 1\n# robot: rh0\n"));
});

test("joint values and a video are saved", async () => {
  const opened = await open(browser, file);
  const saved = async (name, act) => {
    const download = opened.waitForEvent("download", { timeout: 30000 });
    await act();
    await (await download).saveAs(inFolder(name));
    return readFileSync(inFolder(name));
  };
  const press = (name) => opened.getByRole("button", { name }).click();
  const table = await saved("walk.csv", () => press("Save CSV"));
  assert.equal(table.toString(), await opened.evaluate(() => groebot.csv()));
  const video = await saved("walk.webm", async () => {
    await press("Record video");
    await opened.evaluate(() => groebot.step());
    for (let k = 0; k < 10; k++) await opened.evaluate((at) => groebot.seek(at), 3 + 0.2 * k).then(() => picture(opened));
    await press("Record video");
  });
  // EBML, the container format of WebM.
  assert.deepEqual([...video.subarray(0, 4)], [0x1a, 0x45, 0xdf, 0xa3]);
  assert.ok(video.length > 1000);
  assert.deepEqual(opened.complaints, []);
});

test("walled in it says so and waits; a phone shows it", async () => {
  const walled = ROOM.replace("[0.3, 0.3]", "[0.2, 2.6]").replace("[3.6, 0.4]", "[1.9, 1.3]");
  writeFileSync(inFolder("walled.toml"), walled);
  const opened = await open(browser, page("walled.html", "rh0", "--room", inFolder("walled.toml"), "--start", "0.6,1.2", "--goal", "3,1.2"), { viewport: { width: 390, height: 844 } });
  assert.match(await text(opened), /there is no path/);
  assert.equal(await opened.evaluate(() => groebot.path()), null);
  const seen = await picture(opened);
  await opened.evaluate(() => groebot.furniture("box", null));
  assert.equal(await opened.evaluate(() => groebot.step()), "step");
  assert.ok(!seen.equals(await picture(opened)));
  assert.ok(await opened.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
});
