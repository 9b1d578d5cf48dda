// The data of the page, as written by `touchstone plan --page`. Lengths are in the scene's unit, times in nanoseconds; numbers
// that may be infinite are unknown (numberOf).
export interface RowJson {
  name: string;
  plan: boolean;
  ns_min: unknown;
  ns_median: unknown;
  error: unknown;
  outside: number;
  unanswered: number;
  unswept: number;
  front: boolean;
}
export interface PairJson {
  pair: string;
  balls_first: boolean;
  arithmetic: string;
  candidates: number;
  sampled: number;
  ns_double: unknown;
  ns: unknown;
  balls_share: number;
  cheap_share: number;
  certified_error: unknown;
}
export interface ShapeJson {
  shape: number;
  was: string;
  becomes: string;
  vertices: number;
  left: number;
  bodies: number;
  error: number;
}
export interface SweptJson {
  body: number;
  name: string;
  reason: string;
  steps: number;
  pass_bound: unknown;
  inner: unknown;
}
export interface PlanJson {
  machine: { processor: string; cores: number; load: number; system: string; compiler: string; date: string };
  seed: number;
  steps: number;
  rounds: number;
  pairs: PairJson[];
  shapes: ShapeJson[];
  swept: SweptJson[];
  rows: RowJson[];
  terms: { library: string; lines: string[] }[];
}
export interface PlanPage {
  page: "plan";
  version: number;
  title: string;
  command: string;
  heading: string;
  summary: string[];
  broad_phase: string;
  shapes: string;
  sweeping: string;
  /** Why a row is unsound, or empty; as the rows of the plan. */
  reasons: string[];
  plan: PlanJson;
}
