// Exported motions in third-party readers: their link poses are compared with forward kinematics of the URDF, and with the feet in the table.
import assert from "node:assert/strict";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { browse, groebot, inFolder, root, rows } from "./page.mjs";
import { converted, issues, parsed, shown, three, told, transform, xite } from "./scenes.mjs";
import { joints, links } from "./urdf.mjs";

const WITHIN = 1e-6;
const POSE = ["x", "y", "z", "qx", "qy", "qz", "qw"];
const FORMATS = ["glb", "x3d", "wrl"];
let browser;
const cases = {};

/** A slide, joints that follow others, and a base far away that turns in any way. */
function telescope() {
  const lines = Array.from({ length: 9 }, (_, sample) => {
    const wave = (place) => Math.sin(1.1 * sample + 2.1 * place);
    const quaternion = [0, 1, 2, 3].map(wave);
    const length = Math.hypot(...quaternion);
    const base = [41.3 + wave(5), -27.7 + wave(6), 9.1 + wave(7), ...quaternion.map((x) => x / length)];
    return [0.1 * sample + 5, 0.5 + 0.5 * wave(8), 0.1 + 0.1 * wave(9), 2 * wave(10), ...base];
  });
  const head = ["time [s]", "q:lift [m]", "q:first [m]", "q:wrist [rad]", ...POSE.map((end) => `base_${end} [${end.startsWith("q") ? 1 : "m"}]`)];
  const csv = inFolder("telescope.csv");
  writeFileSync(csv, `# groebot trajectory 1\n# robot: telescope\n${[head, ...lines].map((line) => line.join()).join("\n")}\n`);
  const urdf = path.join(root, "tests/corpus/urdf/telescope.urdf");
  return { csv, urdf, given: ["--robot", urdf] };
}

function walk(robot, ...asked) {
  const [csv, urdf] = [inFolder(`${robot}.csv`), inFolder(`${robot}.urdf`)];
  groebot("walk", robot, ...asked, "-o", csv, "--quiet");
  groebot("export", robot, "--to", "urdf", "-o", urdf);
  return { csv, urdf, given: [] };
}

before(async () => {
  browser = await browse();
  Object.assign(cases, { nao: walk("nao", "--steps", "4", "--turn", "10"), rh0: walk("rh0", "--steps", "2"), telescope: telescope() });
  for (const [name, own] of Object.entries(cases)) {
    own.table = rows(own.csv);
    own.samples = [0, 1, ...[0.21, 0.5, 0.77].map((share) => Math.floor(share * own.table.length)), own.table.length - 1];
    const all = joints(own.urdf);
    const values = (row) => Object.fromEntries(Object.entries(row).flatMap(([key, value]) => (key.startsWith("q:") ? [[key.slice(2), value]] : [])));
    own.expected = (row) => links(all, values(row), POSE.map((end) => row[`base_${end}`]));
    own.names = Object.keys(own.expected(own.table[0]));
    // Each link with its ancestors, up to the root of the scene.
    const parents = Object.fromEntries(all.map(({ child, parent }) => [child, parent]));
    own.chain = (link) => (link ? [link, ...own.chain(parents[link])] : name === "telescope" ? ["z_up", "far_base"] : ["z_up"]);
    own.files = Object.fromEntries(FORMATS.map((format) => {
      const file = inFolder(`${name}.${format}`);
      groebot("export", own.csv, "--to", format, ...own.given, "-o", file);
      return [format, file];
    }));
  }
});
after(() => browser?.close());

/** y is up in scenes. */
const up = ([x, y, z]) => [x, z, -y];
const distance = (a, b) => Math.hypot(...a.map((x, place) => x - b[place]));

/** How far a reader sees links from where they are, at most [m]. */
async function furthest({ table, samples, expected, names }, places) {
  let most = 0;
  for (const sample of samples) {
    const [seen, row] = [await places(sample), table[sample]];
    const frames = expected(row);
    for (const name of names) {
      assert.ok(seen[name], `${name} is not there`);
      most = Math.max(most, distance(seen[name], up([3, 7, 11].map((place) => frames[name][place]))));
    }
    // The feet in the table, to its nine decimals.
    for (const side of ["left", "right"].filter((side) => `${side}_x` in row && `${side[0]}_sole` in frames)) {
      most = Math.max(most, distance(seen[`${side[0]}_sole`], up(["x", "y", "z"].map((end) => row[`${side}_${end}`]))));
    }
  }
  return most;
}

const agrees = async (own, reader, name, places) => {
  const most = await furthest(own, places);
  console.log(`${name} in ${reader}: ${most.toExponential(1)} m`);
  assert.ok(most < WITHIN, `${name} in ${reader}: ${most} m`);
};

test("glTF is valid, and three and glTF Transform see the links where they are", async () => {
  for (const [name, own] of Object.entries(cases)) {
    const { numErrors, numWarnings, messages } = await issues(own.files.glb);
    assert.deepEqual([numErrors, numWarnings, messages.filter(({ code }) => code !== "NODE_EMPTY")], [0, 0, []]);
    await agrees(own, "three", name, await three(own.files.glb));
    await agrees(own, "glTF Transform", name, await transform(own.files.glb));
    console.log(`${name}: ${own.table.length} samples, ${FORMATS.map((format) => `${format} ${statSync(own.files[format]).size}`).join(", ")} bytes`);
  }
});

test("X3D and VRML pass tovrmlx3d without a word, and its output has the links where they are", async () => {
  for (const [name, own] of Object.entries(cases)) {
    for (const format of ["x3d", "wrl"]) {
      const { text, said } = converted(own.files[format]);
      assert.equal(said, "");
      await agrees(own, `tovrmlx3d (${format})`, name, told(text));
      const { clocks, moves } = parsed(text);
      const seconds = own.table.at(-1).time - own.table[0].time;
      assert.ok(clocks.length === 1 && clocks[0].loop === "true" && Math.abs(clocks[0].seconds - seconds) < 1e-6);
      for (const [, , { keys }] of moves) {
        keys.forEach((key, sample) => assert.ok(Math.abs(key * seconds - (own.table[sample].time - own.table[0].time)) < 1e-5));
      }
    }
  }
});

test("X_ITE plays X3D and VRML without a word, and sees the links where they are", async () => {
  const page = await xite(browser);
  for (const [name, own] of Object.entries(cases)) {
    for (const format of ["x3d", "wrl"]) {
      const chains = Object.fromEntries(own.names.map((link) => [link, own.chain(link)]));
      await agrees(own, `X_ITE (${format})`, name, await shown(page, own.files[format], chains));
    }
  }
  assert.deepEqual(page.complaints, []);
});

test("X_ITE's clock moves the robot", async () => {
  const page = await xite(browser);
  const text = readFileSync(cases.nao.files.x3d, "utf8");
  const [share, turned] = await page.evaluate(async (text) => {
    const browser = X3D.getBrowser();
    const scene = await browser.createX3DFromString(text);
    await browser.replaceWorld(scene);
    const [clock, knee] = [scene.getNamedNode("Clock"), scene.getNamedNode("LTibia")];
    while (!(clock.fraction_changed > 0.2)) await browser.nextFrame();
    clock.enabled = false;
    await browser.nextFrame();
    return [clock.fraction_changed, knee.rotation.angle];
  }, text);
  const { table } = cases.nao;
  const time = share * table.at(-1).time;
  const next = table.findIndex((row) => row.time > time);
  const [a, b] = [table[next - 1], table[next]];
  const expected = a["q:LKneePitch"] + ((time - a.time) / (b.time - a.time)) * (b["q:LKneePitch"] - a["q:LKneePitch"]);
  assert.ok(Math.abs(turned - expected) < 1e-6, `${turned} is not ${expected}`);
  assert.deepEqual(page.complaints, []);
});

test("the arm of the thesis' figure is seen", async () => {
  const file = path.join(root, "tests/corpus/vrml/rh0_figure_5_4.wrl");
  for (const format of FORMATS) groebot("export", file, "--to", format, "-o", inFolder(`arm.${format}`));
  const { numErrors, numWarnings } = await issues(inFolder("arm.glb"));
  assert.deepEqual([numErrors, numWarnings], [0, 0]);
  for (const format of ["x3d", "wrl"]) {
    const { text, said } = converted(inFolder(`arm.${format}`));
    assert.equal(said, "");
    assert.match(text, /<Box\s+size="0.0199999\d* 0.25 0.0199999\d*"/);
    assert.match(text, /emissiveColor="0.15000000\d* 0.15000000\d* 0"/);
  }
});
