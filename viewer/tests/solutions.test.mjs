// All solutions of an arm while its target is moved.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import path from "node:path";
import { after, before, test } from "node:test";
import { browse, inFolder, open, page, picture, program, root } from "./page.mjs";

const UR5 = path.join(root, "derivations/ur5");
/** The maker's Denavit-Hartenberg parameters: d, a, alpha. */
const DH = [
  [0.089159, 0, Math.PI / 2], [0, -0.425, 0], [0, -0.39225, 0], [0.10915, 0, Math.PI / 2], [0.09465, 0, -Math.PI / 2], [0.0823, 0, 0],
];
let browser, shown;
before(async () => {
  browser = await browse();
  shown = await open(browser, page("ur5.html", UR5));
});
after(() => browser?.close());

/** The pose of the tool at joint values: position, then the rotation by rows. */
function reached(q) {
  let m = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  DH.forEach(([d, a, alpha], joint) => {
    const [c, s, ca, sa] = [Math.cos(q[joint]), Math.sin(q[joint]), Math.cos(alpha), Math.sin(alpha)];
    const own = [c, -s * ca, s * sa, a * c, s, c * ca, -c * sa, a * s, 0, sa, ca, d, 0, 0, 0, 1];
    m = m.map((_, place) => [0, 1, 2, 3].reduce((sum, k) => sum + m[4 * (place >> 2) + k] * own[4 * k + (place & 3)], 0));
  });
  return [m[3], m[7], m[11], m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]];
}

/** Numbers between 0 and 1, the same at every run. */
function random(seed) {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

test("solutions are those of groebot solve to the last bit, and reach the target", async () => {
  const next = random(7);
  const targets = Array.from({ length: 1000 }, () => reached(DH.map(() => (2 * next() - 1) * Math.PI)));
  const lines = execFileSync(program, ["solve", UR5, "--json"], { input: `${targets.join("\n")}\n`, encoding: "utf8", maxBuffer: 1 << 28 });
  const expected = lines.trim().split("\n").map((line) => JSON.parse(line).solutions);
  const [found, times] = await shown.evaluate((all) => {
    const spent = [];
    const each = (target) => {
      groebot.drag("ur5", target);
      spent.push(groebot.update_ms);
      return groebot.solutions();
    };
    return [all.map(each), spent.sort((a, b) => a - b)];
  }, targets);
  let count = 0;
  found.forEach((solutions, place) => {
    assert.equal(solutions.length, expected[place].length);
    solutions.forEach(({ q, branch, residual, within, outside, free }, k) => {
      count += 1;
      const other = expected[place][k];
      assert.ok(q.every((value, joint) => Object.is(value, other.q[joint])) && branch === other.branch && residual === other.residual);
      assert.ok(within && outside.length === 0 && free.length === 0);
      const off = Math.max(...reached(q).map((value, own) => Math.abs(value - targets[place][own])));
      assert.ok(off < 1e-6, `it is ${off} off`);
    });
  });
  assert.ok(count > 6000);
  const [median, slow] = [times[500], times[950]];
  console.log(`an update takes ${median.toFixed(2)} ms in the median, ${slow.toFixed(2)} ms at the 95th percentile`);
  assert.ok(slow < 20);
});

test("rows and fields take solutions and targets", async () => {
  await shown.evaluate((target) => groebot.drag("ur5", target), reached([0.3, -0.9, 1.1, 0.4, 0.8, 0.7]));
  const rows = shown.locator("#solutions li:visible button");
  const solutions = await shown.evaluate(() => groebot.solutions());
  assert.equal(await rows.count(), solutions.length);
  const before = await picture(shown);
  await rows.nth(1).click();
  const { joints } = await shown.evaluate(() => groebot.pose());
  assert.deepEqual(Object.values(joints).slice(0, 6), solutions[1].q);
  assert.equal(await rows.nth(1).getAttribute("aria-pressed"), "true");
  assert.ok(!before.equals(await picture(shown)), "another pose is another picture");
  const still = await picture(shown);
  await rows.nth(2).hover();
  assert.ok(!still.equals(await picture(shown)), "a copy is highlighted");
  const x = shown.getByLabel("Target x, metres");
  const told = Number(await x.inputValue());
  await x.fill(String(told - 0.05));
  const moved = await shown.evaluate(() => groebot.solutions());
  assert.ok(moved.every(({ q }) => Math.abs(reached(q)[0] - told + 0.05) < 1e-4));
  await x.fill("5");
  assert.match(await shown.locator("#solutions-state").innerText(), /Out of reach/);
  assert.equal(await rows.count(), 0);
  await assert.rejects(shown.evaluate(() => groebot.drag("arm", [])), /there is no limb arm; there are ur5/);
  await assert.rejects(shown.evaluate(() => groebot.drag("ur5", [1, 2])), /twelve finite numbers/);
  assert.deepEqual([shown.requests, shown.complaints], [[], []]);
});

test("the target is dragged in the picture, and turned", async () => {
  await shown.evaluate((target) => groebot.drag("ur5", target), reached([0.3, -0.9, 1.1, 0.4, 0.8, 0.7]));
  const field = async (name) => Number(await shown.getByLabel(name).inputValue());
  const before = await field("Target z, metres");
  const place = await shown.evaluate(() => groebot.screen([3, 7, 11].map((place) => groebot.pose().links.tip[place])));
  await shown.mouse.move(place[0], place[1] - 60);
  await shown.mouse.down();
  await shown.mouse.move(place[0], place[1] - 110, { steps: 5 });
  await shown.mouse.up();
  assert.ok((await field("Target z, metres")) > before + 0.02, "its upper arrow was drawn up");
  assert.ok((await shown.evaluate(() => groebot.solutions())).length > 0);
  const turned = await picture(shown);
  await shown.getByRole("button", { name: "Turn" }).click();
  assert.ok(!turned.equals(await picture(shown)));
  await shown.getByRole("button", { name: "Move" }).click();
});

test("a singular pose tells its self-motion, joints beyond limits their names", async () => {
  await shown.evaluate((target) => groebot.drag("ur5", target), reached([0.3, -0.9, 1.1, 0.4, 0, 0.7]));
  const free = (await shown.evaluate(() => groebot.solutions())).flatMap((solution) => solution.free);
  assert.ok(free.includes("Wrist3"), `free: ${free}`);
  assert.match(await shown.locator("#solutions ol").innerText(), /self-motion about Wrist3/);
  const target = reached([0.3, -0.9, 1.1, 0.4, 0, 0.7]);
  const motions = await shown.evaluate(() => groebot.solutions().map(({ free }, place) => [free.length > 0, groebot.self_motion(place)]));
  for (const [isFree, along] of motions) {
    assert.equal(along.length > 0, isFree);
    for (const q of along) assert.ok(reached(q).every((value, place) => Math.abs(value - target[place]) < 1e-6));
    assert.equal(new Set(along.map((q) => q[5].toFixed(6))).size, along.length);
  }
  const canvas = async () => (await picture(shown), shown.locator("#canvas").screenshot());
  const row = shown.locator("#solutions li:visible button").filter({ hasText: "self-motion" }).first();
  await row.click();
  const spread = await canvas();
  await row.blur();
  await shown.getByRole("heading", { name: "Solutions" }).hover();
  // The robot itself shows that solution, which has no copy.
  assert.ok(!spread.equals(await canvas()), "copies are along the self-motion");
  const leg = await open(browser, page("leg.html", path.join(root, "derivations/nao_left_leg")));
  const far = await leg.evaluate(() => groebot.solutions());
  assert.ok(far.some(({ outside }) => outside.length > 0) && far.some(({ within }) => within));
  assert.match(await leg.locator("#solutions ol").innerText(), /beyond the limits of /);
  assert.match(await leg.locator("#certificate").innerText(), /^Certificate [0-9a-f]{64}$/);
  const [hash] = (await leg.locator("#certificate").innerText()).match(/[0-9a-f]{64}/);
  await leg.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await leg.getByRole("button", { name: "Copy the hash" }).click();
  assert.equal(await leg.evaluate(() => navigator.clipboard.readText()), hash);
});

test("sliders lead the target, and the panel closes by its key", async () => {
  await shown.keyboard.press("j");
  const slider = shown.getByLabel("Elbow", { exact: true });
  await slider.evaluate((input) => {
    input.value = "1.25";
    input.dispatchEvent(new Event("input"));
  });
  const { joints } = await shown.evaluate(() => groebot.pose());
  assert.ok(Math.abs(joints.Elbow - 1.25) < 1e-9);
  await shown.locator("#canvas").focus();
  await shown.keyboard.press("s");
  assert.ok(await shown.locator("#solutions").isVisible() && !(await shown.locator("#joints").isVisible()));
  await shown.keyboard.press("s");
  assert.ok(!(await shown.locator("#solutions").isVisible()));
});

test("lengths of a chain in millimetres are metres in the page", async () => {
  const puma = await open(browser, page("puma.html", path.join(root, "derivations/puma")));
  const { links } = await puma.evaluate(() => groebot.pose());
  assert.ok(Math.hypot(links.tip[3], links.tip[7], links.tip[11]) < 5);
  assert.ok((await puma.evaluate(() => groebot.solutions())).length > 0);
});

test("a phone shows the solutions below the picture", async () => {
  const phone = await open(browser, inFolder("ur5.html"), { viewport: { width: 390, height: 844 }, hasTouch: true });
  assert.ok(await phone.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
  assert.ok((await phone.locator("#solutions").boundingBox()).y > 300);
  assert.ok((await phone.locator("#canvas").boundingBox()).height > 200);
});

test("a solver of another task than poses has no controls of solutions", async () => {
  const opened = await open(browser, page("ray.html", path.join(root, "derivations/nao_left_arm")));
  assert.equal(opened.failure, null);
  assert.match(await opened.locator("#solutions-state").innerText(), /nao_left_arm is not solved for a pose of its tip/);
  for (const id of ["limb-choice", "shown", "target-move", "target-turn"]) assert.ok(await opened.locator(`#${id}`).isHidden(), id);
});
