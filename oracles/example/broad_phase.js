// A broad phase behind a pipe: a box around each body, all pairs tested. See pipe_protocol.md.
//   touchstone certify --subject 'pipe:node broad_phase.js'
"use strict";
const say = (answer) => process.stdout.write(JSON.stringify(answer) + "\n");
const sum = (list = []) => list.reduce((s, x) => s + Math.abs(x), 0);

// An upper bound on the distance of any point from the body's origin: |x| + |y| + |z| is at least the length.
function reach(shape) {
  if (shape.type === "half_space") return Infinity;
  let r = (shape.radius || 0) + (shape.half_height || 0) + sum(shape.half_extents) + sum(shape.semi_axes);
  for (const v of shape.vertices || []) r = Math.max(r, sum(v));
  return r * (1 + 2 ** -48);
}

// Rounded outward: if a bound were too small by a single bit, a pair could be lost.
const down = (x) => x - Math.abs(x) * 2 ** -52 - Number.MIN_VALUE;
function boxOf(scene, step) {
  const r = reach(scene.shapes[scene.bodies[step.body].shape]), t = step.pose.translation;
  return { lo: t.map((x) => down(x - r)), hi: t.map((x) => -down(-x - r)) };
}

const overlap = (a, b) => [0, 1, 2].every((k) => a.lo[k] <= b.hi[k] && b.lo[k] <= a.hi[k]);

function candidates(scene) {
  const present = new Map(), lists = [];
  for (const step of scene.steps) {
    if (step.op === "remove") present.delete(step.body);
    else if (step.op !== "query") present.set(step.body, boxOf(scene, step));
    else {
      const all = [...present], list = [];
      all.forEach(([a, x], i) => all.slice(i + 1).forEach(([b, y]) => overlap(x, y) && list.push([a, b])));
      lists.push(list);
    }
  }
  return { pairs: lists };
}

say({ touchstone_pipe: 1, name: "mine-js", library: "mine", version: "1", settings: "all pairs of boxes",
      unit_roundoff: 1.1102230246251565e-16, tau_factor: 64, source: "arithmetic only" });
let scene = null;
require("readline").createInterface({ input: process.stdin }).on("line", (line) => {
  const message = JSON.parse(line);
  if (message.scene) scene = message.scene;
  else say(message.ask === "candidates" ? candidates(scene) : { outcome: "unsupported" });
});
