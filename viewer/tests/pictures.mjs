// Draws the pictures of docs/simulator.md: npm run pictures.
import path from "node:path";
import { browse, groebot, inFolder, open, page, root } from "./page.mjs";

const PICTURES = [
  ["simulator_walk", ["walk.json"], { viewport: { width: 900, height: 580 } }, 4.3],
  ["simulator_joints", ["nao"], { viewport: { width: 900, height: 580 } }],
  ["simulator_phone", ["walk.json"], { viewport: { width: 390, height: 760 }, colorScheme: "dark" }, 6.1],
];

groebot("walk", "nao", "--turn", "8", "-o", inFolder("walk.json"), "--quiet");
process.chdir(inFolder("."));
const browser = await browse();
for (const [name, given, options, time] of PICTURES) {
  const opened = await open(browser, page(`${name}.html`, ...given), options);
  if (time !== undefined) await opened.evaluate((time) => groebot.seek(time), time);
  else await opened.getByLabel("LShoulderRoll", { exact: true }).fill("0.9");
  await opened.waitForTimeout(500);
  await opened.screenshot({ path: path.join(root, "docs", `${name}.png`) });
}
await browser.close();
