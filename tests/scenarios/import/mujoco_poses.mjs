// Writes what MuJoCo makes of an MJCF file, as the tests of the import compare it:
//   npm install @mujoco/mujoco && node mujoco_poses.mjs FOLDER FILE.xml > FILE.poses
// Joints get values that are not zero. A line each: "joint NAME values", "body NAME position quaternion (w first)",
// "geom NAME position matrix (by rows)", "exclude BODY BODY".
import fs from "node:fs";
import path from "node:path";
import load from "@mujoco/mujoco";

const [folder, file] = process.argv.slice(2);
const mj = await load({ print: console.error, printErr: console.error });
function copy(from, to) {
  mj.FS.mkdirTree(to);
  for (const e of fs.readdirSync(from, { withFileTypes: true })) {
    const a = path.join(from, e.name), b = `${to}/${e.name}`;
    if (e.isDirectory()) copy(a, b);
    else mj.FS.writeFile(b, fs.readFileSync(a));
  }
}
copy(folder, "/model");
const model = mj.MjModel.from_xml_path(`/model/${file}`), data = new mj.MjData(model);
const kinds = mj.mjtObj;
const name = (kind, i) => mj.mj_id2name(model, kind.value, i);
const part = (list, i, n) => Array.from(list.slice(n * i, n * i + n));

const ball = 1, free = 0;
for (let j = 0; j < model.njnt; ++j) {
  const type = model.jnt_type[j], at = model.jnt_qposadr[j];
  if (type === free) continue;
  const values = type === ball ? [1, 0.1 * (j % 3), -0.2, 0.05 * (j % 5)] : [0.3 - 0.07 * j];
  values.forEach((v, k) => (data.qpos[at + k] = v));
  console.log("joint", name(kinds.mjOBJ_JOINT, j), ...values);
}
mj.mj_kinematics(model, data);
for (let b = 1; b < model.nbody; ++b)
  if (name(kinds.mjOBJ_BODY, b))
    console.log("body", name(kinds.mjOBJ_BODY, b), ...part(data.xpos, b, 3), ...part(data.xquat, b, 4));
for (let g = 0; g < model.ngeom; ++g)
  console.log("geom", name(kinds.mjOBJ_GEOM, g), ...part(data.geom_xpos, g, 3), ...part(data.geom_xmat, g, 9));
for (let e = 0; e < model.nexclude; ++e) {
  const s = model.exclude_signature[e];
  console.log("exclude", name(kinds.mjOBJ_BODY, s >> 16), name(kinds.mjOBJ_BODY, s & 0xffff));
}
