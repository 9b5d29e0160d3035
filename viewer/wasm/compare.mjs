// Checks that two builds of groebot.wasm return identical responses: node compare.mjs ONE OTHER. Bytes of two builds
// differ with the path of the sources; responses must not.
import { readFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");
const read = (...parts) => readFileSync(path.join(root, ...parts), "utf8");

/** Asks a module: request text to answer text. */
function asker(file) {
  const { exports } = new WebAssembly.Instance(new WebAssembly.Module(readFileSync(file)), {});
  return (request) => {
    const text = new TextEncoder().encode(JSON.stringify(request));
    const place = exports.allocate(text.length);
    new Uint8Array(exports.memory.buffer, place, text.length).set(text);
    const answer = exports.call();
    return new TextDecoder().decode(new Uint8Array(exports.memory.buffer, answer, exports.length()));
  };
}

/** Poses about the origin within a reach, the same at every run. */
function targets(count, reach) {
  let state = 7;
  const next = () => 2 * ((state = (state * 48271) % 2147483647) / 2147483647) - 1;
  return Array.from({ length: count }, () => {
    const q = [next(), next(), next(), next()];
    const [w, x, y, z] = q.map((value) => value / Math.hypot(...q));
    const rows = [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)];
    return [reach * next(), reach * next(), reach * next(), ...rows];
  });
}

const requests = [];
for (const [solver, [name, reach]] of [["ur5", 0.5], ["rh0_left_leg", 0.4], ["general_6r", 1]].entries()) {
  requests.push({ open: read("derivations", name, "5_program.json") });
  requests.push(...targets(200, reach).map((target) => ({ solve: { solver, target } })));
}
// A redundant arm: derivations/planar_3r with the task planar_position, an elbow of -2 to 2 rad, and its solver without a given joint.
requests.push({ open: read("viewer/wasm/planar_arm.json") });
const arcs = targets(100, 0.7).map(([x, y]) => ({ arcs: { solver: 3, target: [x, y], near: [0.1, 0.5, 0.2] } }));
requests.push(...arcs.flatMap((request) => [request, { points: { solver: 3, arc: 0, distances: [0, 0.7, 1.4, 99] } }]));
const room = read("examples/living_room.toml");
for (const robot of ["rh0", "nao", "teo"]) {
  requests.push({ run: { robot, room, start: [1, 2.6, 0], goal: [7.2, 3.4], apart: 0.02 } }, "step", "step");
  requests.push({ furniture: { name: "sofa", at: [3, 1.6, 0] } }, { set: { name: "Hp", value: 0.03 } }, { goal: [1.2, 3.2] }, "step", "step", { set: { name: "Hcm", value: 9 } });
}
requests.push("fly");
const [one, other] = process.argv.slice(2).map(asker);
let [refused, found] = [0, 0];
for (const [place, request] of requests.entries()) {
  const [own, their] = [one(request), other(request)];
  if (own.startsWith('{"error"')) refused += 1;
  if (own.includes('"arcs":[{')) found += 1;
  if (own === their) continue;
  console.error(`request ${place}, ${JSON.stringify(request).slice(0, 200)}: answers differ\n${own.slice(0, 500)}\n${their.slice(0, 500)}`);
  process.exit(1);
}
console.log(`${requests.length} answers are the same, ${refused} of them refusals, ${found} of them arcs`);
if (found < 50) process.exitCode = 1;
