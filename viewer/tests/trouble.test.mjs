// If a part is missing, the page reports it and is never blank.
import assert from "node:assert/strict";
import { before, test } from "node:test";
import { browse, changed, groebot, inFolder, open, page, rows } from "./page.mjs";

let walk, csv;
before(() => {
  csv = inFolder("walk.csv");
  groebot("walk", "nao", "--steps", "2", "-o", csv, "--quiet");
  walk = page("walk.html", csv);
});

test("without WebGL a message stands in the picture's place, and numbers work", async () => {
  const browser = await browse({ webgl: false });
  const opened = await open(browser, walk);
  assert.equal(opened.failure, null);
  assert.match(await opened.locator("#message").innerText(), /No picture[\s\S]*WebGL/);
  const row = rows(csv)[100];
  await opened.locator("#scrub").fill("100");
  assert.equal(await opened.evaluate(() => groebot.pose().joints.LKneePitch), row["q:LKneePitch"]);
  assert.ok(await opened.locator("#lanes canvas").last().isVisible());
  assert.deepEqual(opened.requests, []);
  await browser.close();
});

const BROKEN = [
  ["cut off", (text) => text.replace(/("format":1[\s\S]{2000})[\s\S]*?<\/script>/, "$1</script>"), /not JSON/],
  ["of another format", (text) => text.replace('"format":1', '"format":2'), /format 2; this page reads 1/],
  ["with a number track cut", (text) => text.replace(/"times":"[^"]{16}/, '"times":"'), /damaged/],
  ["with text for numbers", (text) => text.replace(/"times":"[^"]{3}/, '"times":"?!?'), /damaged/],
  ["with a joint out of order", (text) => text.replace(/"parent":\d+/, '"parent":7777'), /damaged.*out of order/],
  ["without a robot", (text) => text.replace('"robot":', '"android":'), /damaged/],
];

test("broken data are told", async () => {
  const browser = await browse();
  for (const [what, change, reason] of BROKEN) {
    const opened = await open(browser, changed(walk, "broken.html", change));
    assert.match(opened.failure ?? "", reason, what);
    const message = opened.locator("#message");
    assert.ok(await message.isVisible(), what);
    assert.match(await message.innerText(), /This page cannot be shown/);
    assert.match(await message.innerText(), reason, what);
    assert.ok(await opened.locator("#dock").isHidden());
    assert.deepEqual(opened.complaints, [], what);
    await opened.context().close();
  }
  await browser.close();
});

test("a robot of which nothing is seen is told", async () => {
  const browser = await browse();
  const empty = (text) => text.replace(/"robot":\{[\s\S]*?"notes":\[\]\}/, '"robot":{"name":"ghost","base":0,"links":[{"name":"a","shapes":[]}],"joints":[],"notes":[]}');
  const opened = await open(browser, changed(page("nao.html", "nao"), "ghost.html", empty));
  assert.match(await opened.locator("#message").innerText(), /Nothing to see[\s\S]*ghost/);
  await browser.close();
});
