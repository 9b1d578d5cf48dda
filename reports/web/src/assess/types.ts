// The data of the page, as written by `touchstone assess -o page.html`.
import type { SceneJson, V3 } from "../case/types";

export interface QuestionJson {
  answered: number;
  wrong: number;
  failed: number;
  unsupported: number;
  median_ns: number;
}
export interface EngineJson {
  engine: string;
  library: string;
  version: string;
  settings: string;
  is_own: boolean;
  questions: Record<string, QuestionJson>;
  distances_apart: number;
  worst_distance_error: number;
  missed: number;
  false_alarms: number;
  denied_collisions: number;
  padding: number | null;
}
export interface StatementJson {
  outcome: string;
  overlap?: boolean;
  distance?: unknown;
  /** Of the distance, if the bodies are apart. */
  error?: number;
  faults: string[];
}
export interface PairJson {
  /** Of the scene's frames. */
  frame: number;
  configuration: number;
  a: number;
  b: number;
  verdict: string;
  gap: [unknown, unknown];
  witness?: [V3, V3];
  /** Whose example it is. */
  of: { engine: string; kind: "missed" | "false" | "distance"; size: number }[];
  engines: Record<string, StatementJson>;
}
export interface AssessPage {
  page: "assess";
  version: number;
  title: string;
  command: string;
  heading: string;
  legend: string[];
  notes: string[];
  advice: string[];
  assessment: { engines: EngineJson[]; asked: number; interrupted: boolean };
  /** The configurations of the pairs are the queries of its script. */
  scene: SceneJson;
  configurations: number[];
  hull_faces: Record<string, V3[]>;
  pairs: PairJson[];
}
