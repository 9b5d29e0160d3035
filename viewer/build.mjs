// Builds dist/: `viewer.js`, the program; `page.html`, its frame with the style; `LICENSES.txt`, of what is bundled.
// With --check it writes nothing and fails where dist/ holds anything else.
import { readFile, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import path from "node:path";
import { build, transform } from "esbuild";

const root = path.dirname(fileURLToPath(import.meta.url));
const at = (...parts) => path.join(root, ...parts);

const bundled = await build({
  entryPoints: [at("src/main.ts")],
  absWorkingDir: root,
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "ascii",
  legalComments: "none",
  write: false,
  metafile: true,
});
const packages = new Set();
for (const input of Object.keys(bundled.metafile.inputs)) {
  const name = input.match(/node_modules\/((?:@[^/]+\/)?[^/]+)\//)?.[1];
  if (name) packages.add(name);
}
let licences = "";
for (const name of [...packages].sort()) {
  const { version, license } = JSON.parse(await readFile(at("node_modules", name, "package.json"), "utf8"));
  const text = await readFile(at("node_modules", name, "LICENSE"), "utf8");
  licences += `${name} ${version} (${license})\n\n${text.trim()}\n`;
}
const script = `/*! Bundled here:\n\n${licences}*/\n${bundled.outputFiles[0].text}`;
if (/<\/script|<!--/i.test(script)) throw new Error("the bundle would end its own <script>");
const style = await transform(await readFile(at("src/style.css"), "utf8"), { loader: "css", minify: true });
const shell = await readFile(at("src/page.html"), "utf8");

const built = {
  "viewer.js": script,
  "page.html": shell.replace("{{style}}", () => style.code.trim()),
  "LICENSES.txt": licences,
};
const isCheck = process.argv.includes("--check");
let differs = false;
for (const [name, text] of Object.entries(built)) {
  if (!isCheck) await writeFile(at("dist", name), text);
  else if ((await readFile(at("dist", name), "utf8")) !== text) {
    console.error(`dist/${name} is not what the sources build; run npm run build`);
    differs = true;
  }
}
const sizes = Object.entries(built).map(([name, text]) => `${name} ${Buffer.byteLength(text)}`);
console.log(`${sizes.join(", ")} bytes${isCheck && !differs ? ", as committed" : ""}`);
process.exitCode = differs ? 1 : 0;
