// Arcs of solutions of redundant arms, compared with tests/corpus/redundant, which was computed without groebot.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { browse, inFolder, open, page, picture, root } from "./page.mjs";
import { joints, links } from "./urdf.mjs";

const CORPUS = path.join(root, "tests/corpus/redundant");
const PANDA = path.join(CORPUS, "arms/panda.urdf");
const { poses } = JSON.parse(readFileSync(path.join(CORPUS, "panda.json"), "utf8"));
/** Below this least singular value, curves nearly cross, and two programs may join their branches differently. */
const ordinary = poses.filter(({ kind, sigma }) => sigma >= 1e-3 && kind !== "limits");

let browser, panda;
before(async () => {
  browser = await browse();
  panda = await open(browser, page("panda.html", PANDA, "--tip", "panda_hand_tcp"));
});
after(() => browser?.close());

const moving = (file) => joints(file).filter(({ type }) => type !== "fixed");
const vector = ({ q, degrees }) => q ?? degrees.map((value) => (value * Math.PI) / 180);

/** The pose of a link at joint values: position, then the rotation by rows. */
function reached(file, tip, q) {
  const values = Object.fromEntries(moving(file).map(({ name }, place) => [name, q[place]]));
  const m = links(joints(file), values, [0, 0, 0, 0, 0, 0, 1])[tip];
  return [m[3], m[7], m[11], m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]];
}

const drag = async (opened, limb, target) =>
  opened.evaluate(([limb, target]) => (groebot.drag(limb, target), [groebot.solutions(), groebot.outcome]), [limb, target]);
const apart = (a, b) => Math.max(...a.map((value, place) => Math.abs(value - b[place])));

test("arcs and their ends are those of the corpus", async () => {
  assert.ok(ordinary.length >= 8);
  const names = moving(PANDA).map(({ name }) => name);
  const times = [];
  for (const pose of ordinary) {
    const [solutions, outcome] = await drag(panda, "panda_hand_tcp", reached(PANDA, "panda_hand_tcp", vector(pose)));
    times.push(await panda.evaluate(() => groebot.update_ms));
    assert.ok(outcome.startsWith(`${pose.arcs.length} arc`), `${outcome} instead of ${pose.arcs.length}`);
    const arcs = solutions.map(({ arc }) => arc).sort((a, b) => b.length - a.length);
    arcs.forEach(({ length }, place) => assert.ok(Math.abs(length - pose.arcs[place][0]) < 1e-5 * (1 + length)));
    const ends = arcs.flatMap((arc) => arc.ends);
    for (const [, , ...expected] of pose.arcs) {
      for (const [at, q] of [expected.slice(0, 2), expected.slice(2)]) {
        const texts = at.split(" ").map((one) => `${names[one[0] - 1]} at its ${one[1] === "+" ? "upper" : "lower"} limit`);
        assert.ok(ends.some((end) => texts.includes(end.limit) && apart(end.q, q) < 1e-5), `no end ${texts} at ${q}`);
      }
    }
  }
  console.log(`arcs of a Panda take ${times.sort((a, b) => a - b)[times.length >> 1].toFixed(1)} ms in the median, with copies`);
});

test("solutions along each arc reach the target, within limits", async () => {
  const limits = moving(PANDA).map((joint) => joint.limits);
  for (const pose of ordinary.slice(0, 4)) {
    const target = reached(PANDA, "panda_hand_tcp", vector(pose));
    const [solutions] = await drag(panda, "panda_hand_tcp", target);
    const slid = await panda.evaluate(() => {
      const along = (arc, place) => [0, 0.2, 0.5, 0.9, 1].map((share) => (groebot.slide(place, share * arc.length), groebot.solutions()[place].q));
      return groebot.solutions().map(({ arc }, place) => [...along(arc, place), ...groebot.self_motion(place)]);
    });
    for (const [place, found] of slid.entries()) {
      const { length, ends } = solutions[place].arc;
      assert.ok(apart(found[0], ends[0].q) < 1e-9 && apart(found[4], ends[1].q) < 1e-9);
      // An arc is not shorter than its chord.
      assert.ok(Math.hypot(...found[1].map((value, joint) => value - found[0][joint])) <= 0.2 * length + 1e-6);
      for (const q of found) {
        assert.ok(apart(reached(PANDA, "panda_hand_tcp", q), target) < 1e-8);
        assert.ok(q.every((value, joint) => value >= limits[joint][0] - 1e-9 && value <= limits[joint][1] + 1e-9));
      }
    }
  }
});

test("the slider moves the robot along the arc; joint values and labels are shown", async () => {
  const target = reached(PANDA, "panda_hand_tcp", vector(poses[0]));
  await drag(panda, "panda_hand_tcp", target);
  const rows = panda.locator("#solutions li:visible button");
  assert.equal(await rows.count(), 3);
  const longest = rows.filter({ hasText: "length 6.736 rad" });
  await rows.filter({ hasNotText: "6.736" }).first().click();
  assert.match(await longest.innerText(), /panda_joint2 at its lower limit to panda_joint2 at its lower limit/);
  await longest.click();
  const before = await picture(panda);
  const slider = panda.getByLabel(/^Along arc/);
  for (const share of [0, 0.3, 1]) {
    await slider.evaluate((input, share) => {
      input.value = String(share * Number(input.max));
      input.dispatchEvent(new Event("input"));
    }, share);
    const { joints: values, links: frames } = await panda.evaluate(() => groebot.pose());
    const names = moving(PANDA).map(({ name }) => name);
    assert.ok(apart(reached(PANDA, "panda_hand_tcp", names.map((name) => values[name])), target) < 1e-8);
    assert.ok(Math.abs(frames.panda_hand_tcp[3] - target[0]) < 1e-8);
    const texts = await panda.locator("#shown dd").allInnerTexts();
    texts.forEach((text, place) => assert.ok(Math.abs(Number.parseFloat(text.replace("\u2212", "-")) - values[names[place]]) < 5.1e-4));
    if (share !== 0.3) assert.ok(Math.abs(values.panda_joint2 + 1.7628) < 1e-9);
  }
  assert.deepEqual(await panda.locator("#along-ends small").allInnerTexts(), ["panda_joint2 at its lower limit", "panda_joint2 at its lower limit"]);
  assert.ok(!before.equals(await picture(panda)));
  const still = await picture(panda);
  await rows.filter({ hasNotText: "6.736" }).first().hover();
  assert.ok(!still.equals(await picture(panda)), "the copies along another arc are highlighted");
  await assert.rejects(panda.evaluate(() => groebot.slide(9, 0)), /there is no arc 9; there are 3/);
});

test("out of reach, the reason is shown", async () => {
  await panda.getByLabel("Target x, metres").fill("5");
  assert.equal(await panda.locator("#solutions-state").innerText(), "No solution within limits: unreachable");
  assert.equal(await panda.locator("#solutions li:visible").count(), 0);
  assert.ok(!(await panda.locator("#shown").isVisible()));
  assert.deepEqual([panda.requests, panda.complaints], [[], []]);
});

/** The target determines the elbow of an iiwa up to its sign. All its other joints are unlimited here, so that its curves are closed. */
test("closed curves, and joints that are beyond limits", async () => {
  const file = inFolder("iiwa.urdf");
  const limited = /(name="iiwa_joint_4"[^]*?lower=")[^"]*(" upper=")[^"]*/;
  const free = readFileSync(path.join(CORPUS, "arms/iiwa14.urdf"), "utf8").replaceAll('type="revolute"', 'type="continuous"');
  const text = free.replace('name="iiwa_joint_4" type="continuous"', 'name="iiwa_joint_4" type="revolute"').replace(limited, "$1-1$21");
  writeFileSync(file, text);
  const tip = joints(file).at(-1).child;
  const iiwa = await open(browser, page("iiwa.html", file, "--tip", tip));
  const within = reached(file, tip, [0.3, -0.6, 0.4, 0.8, -0.2, 0.7, 0.5]);
  const [solutions] = await drag(iiwa, tip, within);
  // Two signs each of shoulder, elbow and wrist.
  assert.equal(solutions.length, 8);
  for (const { q, arc } of solutions) {
    assert.ok(arc.closed && Math.abs(Math.abs(q[3]) - 0.8) < 1e-7);
    assert.ok(apart(reached(file, tip, q), within) < 1e-8);
  }
  assert.match(await iiwa.locator("#solutions ol").innerText(), /closed curve/);
  await drag(iiwa, tip, reached(file, tip, [0.3, -0.6, 0.4, 1.1, -0.2, 0.7, 0.5]));
  assert.equal(await iiwa.locator("#solutions-state").innerText(), "No solution within limits: reachable, but beyond the limits of iiwa_joint_4");
});
