// Poses of bodies: during the step, x(t) = x0 + v·t and q(t) = exp(t·ω) ∘ q0; in a script, one per query.
import { Quaternion, Vector3 } from "three";
import type { BodyJson, PoseJson, StepJson, V3 } from "./types";

export interface Stand {
  position: V3; // doubles: the GPU sees only differences from the centre
  rotation: Quaternion;
}

const stand = (p: PoseJson | undefined): Stand => {
  const q = p?.rotation ?? [0, 0, 0, 1];
  // Divides by the largest entry first, so that quaternions of any length neither overflow nor underflow.
  const m = Math.max(...q.map(Math.abs));
  return {
    position: p?.translation ?? [0, 0, 0],
    rotation: new Quaternion(q[0] / m, q[1] / m, q[2] / m, q[3] / m).normalize(),
  };
};

export function standAt(body: BodyJson, t: number): Stand {
  const s = stand(body.pose);
  if (!body.motion) return s;
  const v = body.motion.linear ?? [0, 0, 0];
  const w = new Vector3(...(body.motion.angular ?? [0, 0, 0]));
  const angle = w.length() * t;
  const turn = angle === 0 ? new Quaternion() : new Quaternion().setFromAxisAngle(w.normalize(), angle);
  return {
    position: s.position.map((x, i) => x + v[i]! * t) as V3,
    rotation: turn.multiply(s.rotation),
  };
}

/** For each query of the script, the pose of every body, or null if it is absent. */
export function standsOfScript(bodies: BodyJson[], script: StepJson[]): (Stand | null)[][] {
  const now: (Stand | null)[] = bodies.map(() => null);
  const frames: (Stand | null)[][] = [];
  for (const s of script) {
    if (s.op === "query") frames.push([...now]);
    else if (s.op === "remove") now[s.body!] = null;
    else now[s.body!] = stand(s.op === "insert" && !s.pose ? bodies[s.body!]!.pose : s.pose);
  }
  return frames;
}
