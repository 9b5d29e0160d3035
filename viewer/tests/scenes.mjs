// Link poses of an exported scene in third-party programs: each reader returns the positions of all nodes at a sample of the motion.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import path from "node:path";
import { WebIO } from "@gltf-transform/core";
import { AnimationMixer, LoopOnce, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import validator from "gltf-validator";
import { inFolder, root } from "./page.mjs";

/** What Khronos' validator has to say of a file. */
export const issues = async (file) => (await validator.validateBytes(new Uint8Array(readFileSync(file)))).issues;

const bytes = (file) => new Uint8Array(readFileSync(file)).buffer;

/** three plays the animation. */
export async function three(file) {
  const { scene, animations } = await new GLTFLoader().parseAsync(bytes(file), "");
  const mixer = new AnimationMixer(scene);
  const action = mixer.clipAction(animations[0]).setLoop(LoopOnce);
  action.clampWhenFinished = true;
  const times = animations[0].tracks[0].times;
  return (sample) => {
    action.reset().play();
    mixer.setTime(times[sample]);
    scene.updateMatrixWorld(true);
    const places = {};
    // A node is visited before its triangle nodes, which have its name.
    scene.traverse((node) => (places[node.name] ??= new Vector3().setFromMatrixPosition(node.matrixWorld).toArray()));
    return places;
  };
}

/** glTF Transform puts what its samplers tell at a sample into its nodes. */
export async function transform(file) {
  const document = (await new WebIO().readBinary(new Uint8Array(bytes(file)))).getRoot();
  const channels = document.listAnimations()[0].listChannels();
  return (sample) => {
    for (const channel of channels) {
      const value = channel.getSampler().getOutput().getElement(sample, []);
      if (channel.getTargetPath() === "rotation") channel.getTargetNode().setRotation(value);
      else channel.getTargetNode().setTranslation(value);
    }
    return Object.fromEntries(document.listNodes().map((node) => [node.getName(), node.getWorldTranslation()]));
  };
}

/** view3dscene's converter writes the file again, in XML; its own words are `said`. */
export function converted(file) {
  const said = inFolder("said");
  const text = execFileSync("/bin/sh", ["-c", `tovrmlx3d "$1" --encoding=xml 2>"$2"`, "sh", file, said], { encoding: "utf8", maxBuffer: 1 << 28 });
  return { text, said: readFileSync(said, "utf8") };
}

const product = ([a, b, c, d], [e, f, g, h]) => [
  a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e,
];
const turned = (q, v) => product(product(q, [0, ...v]), [q[0], -q[1], -q[2], -q[3]]).slice(1);
const quaternion = ([x, y, z, angle]) => {
  const scale = Math.sin(angle / 2) / Math.hypot(x, y, z);
  return [Math.cos(angle / 2), x * scale, y * scale, z * scale];
};

/** The transforms with names, the clock and the interpolators of X3D in XML. */
export function parsed(text) {
  const [open, transforms, sources, clocks, moves] = [[], {}, {}, [], []];
  for (const [, end, kind, told, empty] of text.matchAll(/<(\/?)([A-Za-z]\w*)((?:\s+[\w:]+=(?:"[^"]*"|'[^']*'))*)\s*(\/?)>/g)) {
    if (end) {
      open.pop();
      continue;
    }
    const fields = Object.fromEntries([...told.matchAll(/([\w:]+)=(?:"([^"]*)"|'([^']*)')/g)].map(([, name, a, b]) => [name, a ?? b]));
    const numbers = (name, usual) => (fields[name] ?? usual).trim().split(/\s+/).map(Number);
    if (kind === "Transform" && fields.DEF) {
      const parent = open.findLast((name) => name);
      transforms[fields.DEF] = { parent, translation: numbers("translation", "0 0 0"), rotation: numbers("rotation", "0 0 1 0") };
    }
    if (kind.endsWith("Interpolator")) sources[fields.DEF] = { keys: numbers("key", ""), values: numbers("keyValue", "") };
    if (kind === "TimeSensor") clocks.push({ name: fields.DEF, seconds: Number(fields.cycleInterval), loop: fields.loop });
    if (kind === "ROUTE" && fields.fromField === "value_changed") moves.push([fields.toNode, fields.toField.replace("set_", ""), sources[fields.fromNode]]);
    if (!empty) open.push(kind === "Transform" ? fields.DEF : undefined);
  }
  return { transforms, clocks, moves };
}

/** The positions that X3D in XML tells, added up here. */
export function told(text) {
  const { transforms, moves } = parsed(text);
  return (sample) => {
    for (const [target, field, { values }] of moves) {
      const size = field === "rotation" ? 4 : 3;
      transforms[target][field] = values.slice(size * sample, size * (sample + 1));
    }
    const pose = (name) => {
      const { parent, translation, rotation } = transforms[name];
      const above = parent ? pose(parent) : { p: [0, 0, 0], q: [1, 0, 0, 0] };
      const shift = turned(above.q, translation);
      return { p: above.p.map((x, place) => x + shift[place]), q: product(above.q, quaternion(rotation)) };
    };
    return Object.fromEntries(Object.keys(transforms).map((name) => [name, pose(name).p]));
  };
}

/** A page with X_ITE in it, at an address that leads to this folder alone; what it complains about stands in `complaints`. */
export async function xite(browser) {
  const page = await browser.newPage({ viewport: { width: 900, height: 600 } });
  const complaints = [];
  // Chromium prints a message for pictures with software rendering.
  page.on("console", (message) => message.text().includes("ReadPixels") || complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  const html = `<!DOCTYPE html><meta charset="utf-8"><link rel="icon" href="data:,"><style>body { margin: 0 }</style>
    <script src="/x_ite.min.js"></script><x3d-canvas style="width: 900px; height: 600px"></x3d-canvas>`;
  await page.route(/.*/, (route) => {
    const { origin, pathname } = new URL(route.request().url());
    if (origin !== "http://x-ite.invalid") return route.abort();
    if (pathname === "/") return route.fulfill({ contentType: "text/html", body: html });
    return route.fulfill({ path: path.join(root, "viewer/node_modules/x_ite/dist", pathname) });
  });
  await page.goto("http://x-ite.invalid/");
  return Object.assign(page, { complaints });
}

/** X_ITE's interpolators get the share of time of a sample, and its routes move its transforms, which its own rotations add up. */
export async function shown(page, file, names) {
  await page.evaluate(async (text) => {
    const browser = X3D.getBrowser();
    const scene = await browser.createX3DFromString(text);
    await browser.replaceWorld(scene);
    globalThis.scene = scene;
    const clock = scene.getNamedNode("Clock");
    clock.enabled = false;
    globalThis.sources = [...scene.routes].filter((route) => route.sourceField === "value_changed").map((route) => route.sourceNode);
  }, readFileSync(file, "utf8"));
  return (sample) => page.evaluate(async ([sample, names]) => {
    for (const source of sources) source.set_fraction = source.key[sample];
    await X3D.getBrowser().nextFrame();
    await X3D.getBrowser().nextFrame();
    return Object.fromEntries(Object.entries(names).map(([name, chain]) => {
      const place = chain.reduce((place, each) => {
        const node = scene.getNamedNode(each);
        return node.rotation.multVec(place).add(node.translation);
      }, new X3D.SFVec3f());
      return [name, [place.x, place.y, place.z]];
    }));
  }, [sample, names]);
}
