// The page of a completed task: furniture, goal and path at each time.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { browse, changed, groebot, inFolder, open, picture } from "./page.mjs";

const ROOM = `size = [3.0, 2.4]
wall = 0.05
start = [0.6, 1.2]
[[furniture]]
name = "chair"
box = [0.4, 0.4]
at = [2.4, 1.2]
[[furniture]]
name = "ball"
circle = 0.1
at = [2.8, 2.2]
`;
let browser;
const file = inFolder("task.html");
before(async () => {
  browser = await browse();
  writeFileSync(inFolder("room.toml"), ROOM);
  groebot("task", "rh0", "--room", inFolder("room.toml"), "--goal", "chair", "--then", "ball=1.5,2.25@2", "--then", "goal=1.6,0.6@4", "-o", inFolder("task.json"), "--view", file, "--quiet");
});
after(() => browser?.close());

test("furniture, goal and path are those of each time", async () => {
  const opened = await open(browser, file);
  const at = (time) => opened.evaluate((time) => (groebot.seek(time), { ...groebot.room(), path: groebot.path(), time: groebot.time }), time);
  const first = await at(0);
  assert.deepEqual([first.furniture.ball, first.furniture.chair], [[2.8, 2.2, 0], [2.4, 1.2, 0]]);
  const shot = await picture(opened);
  const last = await at(1e9);
  assert.deepEqual([last.furniture.ball, last.goal.slice(0, 2)], [[1.5, 2.25, 0], [1.6, 0.6]]);
  assert.notDeepEqual(first.path, last.path);
  const [, second, third] = await opened.evaluate(() => JSON.parse(document.getElementById("groebot-data").textContent).task.stages.map(({ from }) => from));
  const between = await at(0.5 * (second + third));
  assert.ok(between.furniture.ball[0] === 1.5 && between.goal[0] === first.goal[0], JSON.stringify(between));
  await at(1e9);
  const [x, y] = await opened.evaluate(() => groebot.pose().base);
  assert.ok(Math.hypot(x - last.goal[0], y - last.goal[1]) < 0.05, `it stands at ${x}, ${y}`);
  await at(0);
  assert.deepEqual((await opened.evaluate(() => groebot.room())).furniture.ball, [2.8, 2.2, 0]);
  assert.ok(shot.length > 1000);
  await assert.rejects(opened.evaluate(() => groebot.goal(1, 1)), /no simulator/);
  assert.deepEqual([opened.requests, opened.complaints], [[], []]);
});

test("a task without its ways is told to be damaged", async () => {
  const cut = changed(file, "cut.html", (text) => text.replace('"stages":[{', '"stages":[],"others":[{'));
  const opened = await open(browser, cut);
  assert.match(opened.failure ?? "", /damaged/);
});
