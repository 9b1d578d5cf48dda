// The data of the page of causes, as written by `touchstone causes --page`.
import type { SceneJson } from "../case/types";

export interface CaseJson {
  id?: string;
  scene: SceneJson;
}
export interface CauseCase {
  engine: string;
  key: string;
  words: string;
  error_in_l: unknown;
  bodies: number;
  steps: number;
  bits: number;
  /** Of the case that is shown; null: there is none. */
  case?: CaseJson | null;
}
export type Response = "stays" | "gone" | "differs" | "open" | "not applicable";
export interface Cause {
  id: string;
  path: string;
  library: string;
  route: string;
  title: string;
  severity: string;
  documented: string;
  wrong: number;
  asked: number;
  worst_in_l: unknown;
  first_index: number;
  engines: string[];
  questions: string[];
  faults: string[];
  shapes: string[];
  families: string[];
  response: { intervention: string; change: string; response: Response }[];
  consequences: string[];
  smallest: CauseCase;
  defensible: CauseCase;
  worst: CauseCase;
  certificate: unknown;
  program: string;
  no_program: string;
  key_count: number;
  rate_text: string;
  expected: string;
  command: string;
  markdown: string;
}
export interface CausesPage {
  page: "causes";
  version: number;
  title: string;
  command: string;
  record: {
    campaign: string;
    digest: string;
    seed: number;
    cases: number;
    answers: number;
    keys: number;
    unseen_text: string;
    notes: string[];
    causes: Cause[];
  };
}
