// A broad-phase certificate as `touchstone certify -o` stores it, and what the page has beside it.
import type { BodyJson, ShapeJson, StepJson } from "../case/types";

export type Level = "boxes" | "bodies";
export interface Evidence {
  name: string; line: string; kind: string; level: Level;
  planned: number; population: number; cases: number; answered: number; refused: number; steps: number; queries: number;
  pairs_true: number; pairs_reported: number; undecided: number; digest: string; refusal: string;
}
export interface Refutation {
  level: Level; evidence: string; index: number; fault: string; words: string; shrink: string; bodies: number; steps: number;
  script?: { id: string; scene: { shapes: ShapeJson[]; bodies: BodyJson[]; script?: StepJson[] } } | null;
}
export interface CertificatePage {
  page: "certificate"; version: number; title: string; subject: string; file: string;
  scripts: Partial<Record<Level, string>>;
  certificate: {
    subject: string; card: { library: string; version: string; settings: string; unit_roundoff: unknown; source: string };
    plugin_hash: string; program: string; scope: string; seed: number; limit: number; sweeps: boolean; without: string[];
    verdict: Partial<Record<Level, string>>; not_proved: string[]; evidence: Evidence[]; refutations: Refutation[]; digest: string;
  };
}
