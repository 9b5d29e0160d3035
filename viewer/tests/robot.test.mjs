// A robot without a walk: the user moves its joints.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { browse, inFolder, open, page, picture, root } from "./page.mjs";
import { apart, joints, links } from "./urdf.mjs";

const REST = [0, 0, 0, 0, 0, 0, 1];
const corpus = (name) => path.join(root, "tests/corpus/urdf", name);
let browser;
before(async () => (browser = await browse()));
after(() => browser?.close());

/** A value within the limits, another one for each joint. */
const chosen = ({ limits: [low, high] }, place) => low + (high - low) * ((0.37 + 0.61803 * place) % 1);

for (const name of ["ur5.urdf", "nao.urdf", "finger.urdf", "telescope.urdf"]) {
  test(`sliders move ${name} as its URDF says`, async () => {
    const all = joints(corpus(name));
    const opened = await open(browser, page(`${name}.html`, corpus(name)));
    const led = all.filter(({ type, mimic }) => type !== "fixed" && !mimic);
    for (const joint of led) if (joint.type === "continuous") joint.limits = [-Math.PI, Math.PI];
    const values = {};
    for (const [place, joint] of led.entries()) {
      const slider = opened.getByLabel(joint.name, { exact: true });
      const [least, most] = [Number(await slider.getAttribute("min")), Number(await slider.getAttribute("max"))];
      assert.deepEqual([least, most], joint.limits);
      await slider.evaluate((input, value) => {
        input.value = String(value);
        input.dispatchEvent(new Event("input"));
      }, chosen(joint, place));
      values[joint.name] = Number(await slider.inputValue());
      const said = await slider.getAttribute("aria-valuetext");
      assert.match(said, joint.type === "prismatic" ? / m$/ : / rad.*\u00b0$/);
    }
    const pose = await opened.evaluate(() => groebot.pose());
    for (const [joint, value] of Object.entries(values)) assert.equal(pose.joints[joint], value);
    for (const { name: follower, mimic } of all.filter(({ mimic }) => mimic)) {
      assert.ok(Math.abs(pose.joints[follower] - mimic.multiplier * pose.joints[mimic.leader] - mimic.offset) < 1e-12);
      assert.ok(await opened.getByLabel(follower, { exact: true }).isDisabled());
    }
    const off = apart(pose.links, links(all, { ...pose.joints }, REST));
    assert.ok(off < 1e-9, `links are ${off} off`);
    assert.deepEqual([opened.requests, opened.complaints], [[], []]);
    await opened.getByRole("button", { name: "Rest" }).click();
    const rest = await opened.evaluate(() => groebot.pose());
    led.forEach((joint) => assert.equal(rest.joints[joint.name], Math.min(Math.max(0, joint.limits[0]), joint.limits[1])));
  });
}

test("a robot without shapes is seen by its bones", async () => {
  const bare = readFileSync(corpus("ur5.urdf"), "utf8").replaceAll(/<(visual|collision)\b[\s\S]*?<\/\1>/g, "");
  writeFileSync(inFolder("bare.urdf"), bare);
  const opened = await open(browser, page("bare.html", inFolder("bare.urdf")));
  const seen = await picture(opened);
  await opened.getByRole("button", { name: "Robot" }).click();
  assert.ok(!seen.equals(await picture(opened)));
  assert.ok(await opened.locator("#message").isHidden());
});

test("meshes are shown when they are asked for, and told when they cannot be", async () => {
  const facet = (a, b, c) => `facet normal 0 0 0\nouter loop\n${[a, b, c].map((p) => `vertex ${p}\n`).join("")}endloop\nendfacet\n`;
  const [o, x, y, z] = ["0 0 0", "0.3 0 0", "0 0.3 0", "0 0 0.3"];
  writeFileSync(inFolder("part.stl"), `solid part\n${facet(o, y, x)}${facet(o, x, z)}${facet(o, z, y)}${facet(x, y, z)}endsolid part\n`);
  const visual = (mesh) => `<visual><geometry><mesh filename="${mesh}"/></geometry></visual>`;
  const links = `<link name="a">${visual("part.stl")}</link><link name="b">${visual("lost.stl")}</link>`;
  const joint = '<joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 0.5"/><limit lower="-1" upper="1"/></joint>';
  writeFileSync(inFolder("meshes.urdf"), `<robot name="meshes">${links}${joint}</robot>`);
  const [without, shown] = [page("without.html", inFolder("meshes.urdf")), page("with.html", inFolder("meshes.urdf"), "--meshes")];
  const [first, second] = [await open(browser, without), await open(browser, shown)];
  assert.match(await first.locator("#notes").innerText(), /1 note/);
  await first.locator("#notes summary").click();
  assert.match(await first.locator("#notes").innerText(), /Meshes of 2 links are not included; --meshes includes them/);
  await second.locator("#notes summary").click();
  assert.match(await second.locator("#notes").innerText(), /`lost.stl` is not found/);
  assert.ok(!(await picture(first)).equals(await picture(second)));
  assert.deepEqual([first.complaints, second.complaints], [[], []]);
});
