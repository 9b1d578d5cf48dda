// The broad phases of a script as the program writes them (reports/text/packed_broad_view.cpp), and unpacked.
import { pageData } from "../common/page";

/** Lowest and highest corner; an infinite end is null. */
export type Box = [End[], End[]];
type End = number | null;
export type Pair = [number, number];

export interface Grid { along: number; origin: number[]; cell: number[]; count: number[] }
/** One method's structure at one query. */
export interface Look<Pairs = Pair[], Boxes = Box[]> {
  explanation: string; sweep_axis: number; grids: Grid[]; nodes: Boxes[]; considered: number; pruned: Pairs;
}
export interface Frame<Pairs = Pair[], Boxes = Box[], One = Box | null> {
  boxes: One[]; kept: Pairs; all_pairs: number; overlap_on_axis: number[]; looks: Look<Pairs, Boxes>[];
}
export interface BroadPage<F = Frame> { name: string; bodies: string[]; fixed: boolean[]; methods: string[]; step: number; frames: F[] }

type PackedPage = BroadPage<Frame<number[], End[][], End[] | null>> & { origin: number };

/**
 * Boxes are stored as six differences, in steps, from the body's previous box; those of a tree from zero. Pairs are stored
 * as differences from the previous pair.
 */
export function broadPage(): BroadPage {
  const packed = pageData<PackedPage>();
  const end = (k: End): End => (k === null ? null : packed.origin + k * packed.step);
  const box = (v: End[]): Box => [v.slice(0, 3).map(end), v.slice(3).map(end)];
  const last = packed.bodies.map(() => [0, 0, 0, 0, 0, 0]);
  const moved = (v: End[], i: number): Box => box(v.map((x, k) => (x === null ? null : (last[i]![k]! += x))));
  const pairs = (p: number[]): Pair[] => {
    const all: Pair[] = [];
    let a = 0, b = 0;
    for (let i = 0; i < p.length; i += 2) {
      if (p[i] !== 0) b = a += p[i]!;
      b += p[i + 1]!;
      all.push([a, b]);
    }
    return all;
  };
  const data: BroadPage = {
    ...packed,
    frames: packed.frames.map((f) => ({
      ...f,
      boxes: f.boxes.map((v, i) => v && moved(v, i)),
      kept: pairs(f.kept),
      looks: f.looks.map((l) => ({ ...l, pruned: pairs(l.pruned), nodes: l.nodes.map((level) => level.map(box)) })),
    })),
  };
  (globalThis as unknown as { touchstoneData: unknown }).touchstoneData = data;  // for tests and the console
  return data;
}

export const low = (b: Box, k: number): number => b[0][k] ?? -Infinity;
export const high = (b: Box, k: number): number => b[1][k] ?? Infinity;

/** The picture's range over all queries: the finite ends of the moving bodies, or of all bodies if none moves. */
export function rangeOf(data: BroadPage): Pair[] {
  for (const all of [false, true]) {
    const range: Pair[] = [0, 1, 2].map(() => [Infinity, -Infinity]);
    for (const f of data.frames)
      f.boxes.forEach((b, i) => {
        if (!b || (!all && data.fixed[i])) return;
        for (const corner of b)
          corner.forEach((x, k) => {
            if (x !== null) range[k] = [Math.min(range[k]![0], x), Math.max(range[k]![1], x)];
          });
      });
    if (range.every(([from, to]) => from <= to))
      return range.map(([from, to]) => {
        const margin = Math.max((to - from) * 0.06, 1e-9);
        return [from - margin, to + margin];
      });
  }
  return [[-1, 1], [-1, 1], [-1, 1]];
}
