// Draws the pictures of docs/simulator.md: npm run pictures.
import path from "node:path";
import { browse, groebot, inFolder, open, page, root } from "./page.mjs";
import { shown, xite } from "./scenes.mjs";

const PICTURES = [
  ["simulator_walk", ["walk.json"], { viewport: { width: 900, height: 580 } }, 4.3],
  ["simulator_joints", ["nao"], { viewport: { width: 900, height: 580 } }],
  ["simulator_solutions", [path.join(root, "derivations/ur5")], { viewport: { width: 900, height: 580 } }],
  ["simulator_arcs", [path.join(root, "tests/corpus/redundant/arms/panda.urdf"), "--tip", "panda_hand_tcp"], { viewport: { width: 900, height: 640 } }],
  ["simulator_reach", [path.join(root, "derivations/ur5"), "--reach", "map.json"], { viewport: { width: 1000, height: 640 } }],
  ["simulator_room", ["rh0", "--room", "living-room", "--start", "1,2.6", "--goal", "7.2,3.4"], { viewport: { width: 1000, height: 640 } }],
  ["simulator_task", ["task.json"], { viewport: { width: 1000, height: 640 } }],
  ["simulator_phone", ["walk.json"], { viewport: { width: 390, height: 760 }, colorScheme: "dark" }, 6.1],
];

/** What is done before a picture. */
const ACTS = {
  simulator_task: async (opened) => {
    await opened.getByRole("button", { name: "Top" }).click();
    await opened.evaluate(() => groebot.seek(40));
  },
  simulator_joints: (opened) => opened.getByLabel("LShoulderRoll", { exact: true }).fill("0.9"),
  simulator_solutions: (opened) => opened.evaluate(() => groebot.drag("ur5", [-0.4, -0.2, 0.3, 0.6, 0, 0.8, 0, 1, 0, -0.8, 0, 0.6])),
  simulator_arcs: async (opened) => {
    // The ready pose of the maker.
    await opened.evaluate(() => groebot.drag("panda_hand_tcp", [0.306891, 0, 0.486882, 1, 0, 0, 0, -1, 0, 0, 0, -1]));
    await opened.evaluate(() => groebot.slide(groebot.solutions().findIndex(({ arc }) => arc.length > 6), 2.4));
  },
  simulator_reach: async (opened) => {
    await opened.getByRole("button", { name: "Front" }).click();
    await opened.evaluate(() => groebot.reach.show({ upto: [0, 9, 9] }));
  },
  simulator_room: (opened) =>
    opened.evaluate(() => {
      for (let step = 0; step < 14; step++) groebot.step();
      groebot.furniture("sofa", [4, 1.9, 0.3]);
      groebot.seek(38);
    }),
};

groebot("walk", "nao", "--turn", "8", "-o", inFolder("walk.json"), "--quiet");
groebot("task", "rh0", "--room", "living-room", "--goal", "sofa", "--furniture", "piano=2.6,2.6,20", "-o", inFolder("task.json"), "--quiet");
process.chdir(inFolder("."));
groebot("reach", path.join(root, "derivations/ur5"), "-o", "map.json", "--quiet");
const browser = await browse();
for (const [name, given, options, time] of PICTURES) {
  const opened = await open(browser, page(`${name}.html`, ...given), options);
  if (time !== undefined) await opened.evaluate((time) => groebot.seek(time), time);
  else await ACTS[name](opened);
  await opened.waitForTimeout(500);
  await opened.screenshot({ path: path.join(root, "docs", `${name}.png`) });
}
// The same walk, exported, in X_ITE.
groebot("export", "walk.json", "--to", "x3d", "-o", inFolder("walk.x3d"));
const player = await xite(browser);
await (await shown(player, inFolder("walk.x3d"), {}))(430);
// The name of the view disappears.
await player.waitForTimeout(8000);
await player.screenshot({ path: path.join(root, "docs/simulator_export.png") });
await browser.close();
