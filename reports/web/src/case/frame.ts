// Where the bodies of a scene are over all its frames, for every picture of them; and their colours.
import type { Stand } from "./motion";
import { reachOf } from "./shapes";
import type { SceneJson, V3 } from "./types";

/** Paler than the engines' colours. */
export const bodyColours = ["#7f93ad", "#c4b184"] as const;

/** Centre and size of the scene over all frames. Half-spaces have no size; a scene with nothing else has size 1. */
export function frameOf(scene: SceneJson, frames: (Stand | null)[][]): [V3, number] {
  const low: V3 = [Infinity, Infinity, Infinity], high: V3 = [-Infinity, -Infinity, -Infinity];
  const { shapes, bodies } = scene;
  const reach = bodies.map((b) => reachOf(shapes[b.shape]!));
  const sized = reach.filter((r) => r > 0).sort((a, b) => a - b);
  // A mesh or body a thousand times larger than the smallest is taken as the ground and does not set the size.
  const most = (sized[0] ?? 1) * 1000;
  for (const stands of frames)
    stands.forEach((s, i) => {
      if (!s || reach[i]! <= 0 || (reach[i]! > most && bodies.length > 1)) return;
      for (let k = 0; k < 3; ++k) {
        low[k] = Math.min(low[k]!, s.position[k]! - reach[i]!);
        high[k] = Math.max(high[k]!, s.position[k]! + reach[i]!);
      }
    });
  if (!low.every(Number.isFinite)) return [frames[0]?.find((s) => s)?.position ?? [0, 0, 0], 1];
  const centre = low.map((x, k) => x / 2 + high[k]! / 2) as V3;
  const size = Math.max(...high.map((x, k) => x - low[k]!));
  return [centre, size > 0 ? size : 1];
}
