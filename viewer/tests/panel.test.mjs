// The simulator's panel while the user types, plays and records.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { browse, inFolder, open, page } from "./page.mjs";

let browser, file;
before(async () => {
  browser = await browse();
  writeFileSync(inFolder("panel.toml"), "size = [4.0, 2.6]\nwall = 0.05\n");
  file = page("panel.html", "rh0", "--room", inFolder("panel.toml"), "--start", "0.6,1.2", "--goal", "3,1.2");
});
after(() => browser?.close());

const text = (opened) => opened.locator("#run-state").innerText();
const room = (opened) => opened.evaluate(() => groebot.room());
const fieldOf = (opened, name) => opened.getByLabel(name);
const placeField = (opened, place) => opened.locator("#place input").nth(place);
const enter = async (field, value) => (await field.fill(value), field.press("Enter"));

/** Types over what a field holds. */
async function type(opened, field, value) {
  await field.click();
  await opened.keyboard.press("Control+A");
  await opened.keyboard.type(value);
}

test("digits and letters that are typed are no keys of the page", async () => {
  const opened = await open(browser, file);
  const view = () => opened.locator("#views [aria-pressed=true]").innerText();
  const before = await view();
  await type(opened, fieldOf(opened, /^Lp/), "0.12");
  await opened.keyboard.press("Enter");
  assert.equal((await opened.evaluate(() => groebot.parameters)).Lp, 0.12);
  assert.equal(await view(), before);
  await opened.locator("#thing").focus();
  for (const key of ["t", "r", "j", "1"]) await opened.keyboard.press(key);
  assert.equal(await view(), before);
  assert.ok(await opened.locator("#run").isVisible());
  await opened.locator("#scrub").focus();
  await opened.keyboard.press("1");
  assert.equal(await view(), "Front");
});

test("what is half typed stays until it is tried; then all fields show what holds", async () => {
  const opened = await open(browser, file);
  const [figure, x] = [fieldOf(opened, /^Lp/), placeField(opened, 0)];
  const step = () => opened.evaluate(() => groebot.step());
  await type(opened, figure, "0.1");
  await step();
  assert.equal(await figure.inputValue(), "0.1");
  await enter(figure, "");
  assert.equal(await text(opened), "give a number for Lp");
  assert.equal(await figure.inputValue(), "0.16");
  await type(opened, x, "2.7");
  await step();
  assert.equal(await x.inputValue(), "2.7");
  await enter(x, "99");
  assert.notEqual(await text(opened), "2 steps");
  assert.equal(await x.inputValue(), "3");
  await enter(x, "");
  assert.equal(await text(opened), "give a number for x");
  await assert.rejects(opened.evaluate(() => groebot.set("Hp", NaN)), /give a number for Hp/);
  await figure.focus();
  await opened.evaluate(() => groebot.set("Lp", 0.11));
  await opened.locator("#canvas").focus();
  assert.equal(await figure.inputValue(), "0.11");
  assert.deepEqual(opened.complaints, []);
});

test("a goal gets a heading, and loses it", async () => {
  const opened = await open(browser, file);
  const heading = placeField(opened, 2);
  assert.equal(await heading.inputValue(), "");
  await enter(heading, "90");
  assert.deepEqual((await room(opened)).goal, [3, 1.2, Math.PI / 2]);
  await enter(heading, "");
  assert.deepEqual((await room(opened)).goal, [3, 1.2]);
});

test("pause and play within a frame leave one chain of frames", async () => {
  const opened = await open(browser, file);
  const most = await opened.evaluate(async () => {
    const ask = requestAnimationFrame.bind(window);
    const play = document.getElementById("play");
    for (let press = 0; press < 9; press++) play.click();
    let [asked, most] = [0, 0];
    window.requestAnimationFrame = (call) => ((asked += 1), ask(call));
    for (let frame = 0; frame < 12; frame++) {
      asked = 0;
      await new Promise((done) => ask(done));
      most = Math.max(most, asked);
    }
    return most;
  });
  // One of the player, one of the picture.
  assert.ok(most <= 2, `${most} a frame`);
});

test("a reset walk is the same walk", async () => {
  const opened = await open(browser, file);
  const walk = () => opened.evaluate(() => (groebot.step(), groebot.step(), groebot.seek(1e9), [groebot.csv(), groebot.pose(), groebot.margin()]));
  const first = await walk();
  await opened.getByRole("button", { name: "Reset" }).click();
  assert.equal(await opened.evaluate(() => groebot.time), 0);
  assert.deepEqual(await walk(), first);
});

test("a recorded video releases its tracks; without a picture there is none", async () => {
  const opened = await open(browser, file);
  const record = opened.getByRole("button", { name: "Record video" });
  await opened.evaluate(() => {
    const capture = HTMLCanvasElement.prototype.captureStream;
    HTMLCanvasElement.prototype.captureStream = function (...given) {
      return (window.stream = capture.apply(this, given));
    };
  });
  const states = () => opened.evaluate(() => window.stream.getTracks().map(({ readyState }) => readyState));
  await record.click();
  assert.deepEqual(await states(), ["live"]);
  const download = opened.waitForEvent("download");
  await record.click();
  await download;
  assert.deepEqual(await states(), ["ended"]);

  const blind = await browse({ webgl: false });
  const plain = await open(blind, file);
  assert.ok(await plain.getByRole("button", { name: "Record video" }).isDisabled());
  assert.equal(await plain.evaluate(() => groebot.step()), "step");
  await blind.close();
});
