// Furniture in the simulator's room: dragged, with unusual names, and enclosing the robot.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { browse, inFolder, open, page, picture } from "./page.mjs";

/** Furniture may have any name. */
const ROOM = `size = [4.0, 2.6]
wall = 0.05
[[furniture]]
name = "goal"
box = [0.3, 0.3]
at = [3.6, 0.4]
[[furniture]]
name = " old  chair "
circle = 0.15
at = [3.6, 2.2]
`;
let browser, file;
before(async () => {
  browser = await browse();
  file = written("room", ROOM, "0.6,1.2", "3,1.2");
});
after(() => browser?.close());

function written(name, room, start, goal) {
  writeFileSync(inFolder(`${name}.toml`), room);
  return page(`${name}.html`, "rh0", "--room", inFolder(`${name}.toml`), `--start=${start}`, `--goal=${goal}`);
}

const room = (opened) => opened.evaluate(() => groebot.room());

/** Drags by the mouse, with something done before it is let go. */
async function drag(opened, from, to, held = async () => {}) {
  await picture(opened);
  const [a, b] = await opened.evaluate((points) => points.map((point) => groebot.screen(point)), [from, to]);
  await opened.mouse.move(...a);
  await opened.mouse.down();
  await opened.mouse.move(...b, { steps: 4 });
  await held();
  await opened.mouse.up();
}

test("furniture of any name is moved, also one that is called goal", async () => {
  const opened = await open(browser, file);
  const choice = opened.locator("#thing");
  const names = await choice.locator("option").evaluateAll((all) => all.map(({ value }) => value));
  assert.deepEqual(names, ["goal", "goal", " old  chair "]);
  for (const [index, y] of [[1, "0.6"], [2, "2"]]) {
    await choice.selectOption({ index });
    await opened.locator("#place input").nth(1).fill(y);
    await opened.keyboard.press("Enter");
  }
  const { goal, furniture } = await room(opened);
  assert.deepEqual([goal, furniture], [[3, 1.2], { goal: [3.6, 0.6, 0], " old  chair ": [3.6, 2, 0] }]);
  await opened.getByRole("button", { name: "Top" }).click();
  await drag(opened, [3.6, 0.6, 0], [3.4, 0.5, 0]);
  const moved = await room(opened);
  assert.ok(Math.hypot(moved.furniture.goal[0] - 3.4, moved.furniture.goal[1] - 0.5) < 0.02, JSON.stringify(moved));
  assert.deepEqual(moved.goal, [3, 1.2]);
  await opened.evaluate(() => groebot.furniture("goal", null));
  assert.equal((await room(opened)).furniture.goal, undefined);
  await opened.evaluate(() => groebot.furniture("goal", [3.6, 0.4, 0.2]));
  assert.deepEqual((await room(opened)).furniture.goal, [3.6, 0.4, 0.2]);
});

test("a step does not take from the hand what is dragged; a drag that is cancelled drops nothing", async () => {
  const opened = await open(browser, file);
  await opened.getByRole("button", { name: "Top" }).click();
  await drag(opened, [3, 1.2, 0], [2.6, 0.8, 0], () => opened.evaluate(() => groebot.step()));
  const { goal } = await room(opened);
  assert.ok(Math.hypot(goal[0] - 2.6, goal[1] - 0.8) < 0.02, `the goal is at ${goal}`);
  const before = await picture(opened);
  await drag(opened, [...goal, 0], [2, 1.5, 0], async () => {
    assert.ok(!before.equals(await picture(opened)));
    await opened.evaluate(() => document.getElementById("canvas").dispatchEvent(new PointerEvent("pointercancel", { pointerId: 1 })));
  });
  assert.deepEqual((await room(opened)).goal, goal);
  // It is there again and can be dragged.
  await drag(opened, [...goal, 0], [2.4, 1.4, 0]);
  const { goal: next } = await room(opened);
  assert.ok(Math.hypot(next[0] - 2.4, next[1] - 1.4) < 0.02, `the goal is at ${next}`);
});

/** How many pixels of the picture are red. */
async function red(opened) {
  await opened.getByRole("button", { name: "Top" }).click();
  await picture(opened);
  const shot = (await opened.locator("#canvas").screenshot()).toString("base64");
  return opened.evaluate(async (shot) => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(shot), (letter) => letter.charCodeAt(0))]));
    const pen = new OffscreenCanvas(image.width, image.height).getContext("2d");
    pen.drawImage(image, 0, 0);
    const { data } = pen.getImageData(0, 0, image.width, image.height);
    let count = 0;
    for (let at = 0; at < data.length; at += 4) if (data[at] - data[at + 1] > 30) count += 1;
    return count;
  }, shot);
}

test("closed cells are as large in a room that is turned", async () => {
  const walled = (more, at) => `size = [4.0, 2.6]\nwall = 0.05\n${more}[[furniture]]\nname = "wall"\nbox = [0.2, 2.6]\nat = [${at}]\n`;
  const turned = ([x, y]) => [x * Math.cos(Math.PI / 6) - y / 2, x / 2 + y * Math.cos(Math.PI / 6)];
  const [start, goal, at] = [[0.6, 1.2], [3, 1.2], [1.9, 1.3]];
  const straight = await open(browser, written("straight", walled("", at), start, goal));
  const other = await open(browser, written("turned", walled("origin = [0, 0, 30]\n", [...turned(at), 30]), turned(start), turned(goal)));
  assert.match(await other.locator("#run-state").innerText(), /there is no path/);
  const [a, b] = [await red(straight), await red(other)];
  assert.ok(a > 5000 && Math.abs(b / a - 1) < 0.15, `${a} and ${b} pixels`);
  await other.evaluate(() => groebot.furniture("wall", null));
  // Only an axis remains.
  assert.ok((await red(other)) < 100);
  assert.deepEqual([straight.complaints, other.complaints], [[], []]);
});
