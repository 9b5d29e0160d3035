// Forward kinematics of a URDF by a method independent of the page: rotation matrices from quaternions.
import { readFileSync } from "node:fs";

const attribute = (text, name) => text?.match(new RegExp(`\\b${name}="([^"]*)"`))?.[1];
const numbers = (text, usual) => (text ?? usual).trim().split(/\s+/).map(Number);

/** The joints of a URDF, as they stand in the file. */
export function joints(file) {
  const found = readFileSync(file, "utf8").matchAll(/<joint\b([^>]*)>([\s\S]*?)<\/joint>/g);
  // A transmission also names joints.
  return [...found].filter(([, , body]) => body.includes("<child")).map(([, head, body]) => {
    const tag = (name) => body.match(new RegExp(`<${name}\\b[^>]*>`))?.[0];
    const mimic = tag("mimic");
    return {
      name: attribute(head, "name"),
      type: attribute(head, "type"),
      parent: attribute(tag("parent"), "link"),
      child: attribute(tag("child"), "link"),
      xyz: numbers(attribute(tag("origin"), "xyz"), "0 0 0"),
      rpy: numbers(attribute(tag("origin"), "rpy"), "0 0 0"),
      axis: numbers(attribute(tag("axis"), "xyz"), "1 0 0"),
      limits: [Number(attribute(tag("limit"), "lower")), Number(attribute(tag("limit"), "upper"))],
      mimic: mimic && {
        leader: attribute(mimic, "joint"),
        multiplier: Number(attribute(mimic, "multiplier") ?? 1),
        offset: Number(attribute(mimic, "offset") ?? 0),
      },
    };
  });
}

// Quaternions are [w, x, y, z].
const product = ([a, b, c, d], [e, f, g, h]) => [
  a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e,
];
const about = (axis, angle) => {
  const length = Math.hypot(...axis);
  return [Math.cos(angle / 2), ...axis.map((x) => (x / length) * Math.sin(angle / 2))];
};
const turned = (q, v) => product(product(q, [0, ...v]), [q[0], -q[1], -q[2], -q[3]]).slice(1);
const added = (a, b) => a.map((x, place) => x + b[place]);

/** The frames of all links, twelve numbers by rows, for the values of joints and the pose of the root. */
export function links(all, values, [x, y, z, qx, qy, qz, qw]) {
  const children = new Set(all.map(({ child }) => child));
  const base = all.find(({ parent }) => !children.has(parent)).parent;
  const length = Math.hypot(qx, qy, qz, qw);
  const poses = new Map([[base, { p: [x, y, z], q: [qw / length, qx / length, qy / length, qz / length] }]]);
  const value = ({ name, mimic }) =>
    values[name] ?? (mimic ? mimic.multiplier * value(all.find((other) => other.name === mimic.leader)) + mimic.offset : 0);
  // Each round adds at least the children of the joints of the round before.
  for (let round = 0; round < all.length; round++) {
    for (const joint of all) {
      const above = poses.get(joint.parent);
      if (!above || poses.has(joint.child)) continue;
      const [roll, pitch, yaw] = joint.rpy;
      let q = product(above.q, product(about([0, 0, 1], yaw), product(about([0, 1, 0], pitch), about([1, 0, 0], roll))));
      let p = added(above.p, turned(above.q, joint.xyz));
      if (joint.type === "prismatic") p = added(p, turned(q, joint.axis.map((x) => (x / Math.hypot(...joint.axis)) * value(joint))));
      else if (joint.type !== "fixed") q = product(q, about(joint.axis, value(joint)));
      poses.set(joint.child, { p, q });
    }
  }
  const frame = ({ p, q }) => {
    const columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => turned(q, axis));
    return [0, 1, 2].flatMap((row) => [...columns.map((column) => column[row]), p[row]]);
  };
  return Object.fromEntries([...poses].map(([name, pose]) => [name, frame(pose)]));
}

/** The greatest difference of the numbers of two sets of frames; infinite where one has a link that the other has not. */
export function apart(a, b) {
  if (Object.keys(a).sort().join() !== Object.keys(b).sort().join()) return Infinity;
  return Math.max(...Object.keys(a).flatMap((name) => a[name].map((x, place) => Math.abs(x - b[name][place]))));
}
