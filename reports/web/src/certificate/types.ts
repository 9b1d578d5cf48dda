// A broad-phase certificate as stored by `touchstone certify -o`, and the page's further data.
import type { BodyJson, ShapeJson, StepJson } from "../case/types";

export type Level = "boxes" | "bodies";
export interface Evidence {
  name: string; line: string; kind: string; level: Level;
  planned: number; population: number; cases: number; answered: number; refused: number; steps: number; queries: number;
  pairs_true: number; pairs_reported: number; undecided: number; digest: string; refusal: string;
}
export interface FaultClass { fault: string; kind: string }
/** The cases of one suite that show a class of fault. */
export interface FaultCount extends FaultClass { level: Level; evidence: string; cases: number; index: number; share: number; words: string }
export interface TooSlow { level: Level; evidence: string; index: number; bodies: number; steps: number; allowed: number; sufficient: number; tried: number }
export interface Refutation extends FaultClass {
  level: Level; evidence: string; index: number; words: string; shrink: string; bodies: number; steps: number; shown_again: boolean;
  script?: { id: string; scene: { shapes: ShapeJson[]; bodies: BodyJson[]; script?: StepJson[] } } | null;
}
export interface CertificatePage {
  page: "certificate"; version: number; title: string; subject: string; file: string;
  /** One per refutation: the file of its script, "" if none was written. */
  scripts: string[];
  /** `reproduce` can write a program against this engine. */
  has_writer: boolean;
  certificate: {
    subject: string; card: { library: string; version: string; settings: string; unit_roundoff: unknown; source: string };
    plugin_hash: string; program: string; scope: string; seed: number; limit: number; sweeps: boolean; margin?: number; without: string[];
    verdict: Partial<Record<Level, string>>; not_proved: string[]; evidence: Evidence[]; faults: FaultCount[]; refutations: Refutation[]; too_slow: TooSlow[]; digest: string;
  };
}
