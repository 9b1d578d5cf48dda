// The data of a case page, as written by `touchstone view`.
import type { ShapeType } from "./shapes";

export type V3 = [number, number, number];

export interface ShapeJson {
  type: ShapeType;
  radius?: number;
  half_height?: number;
  half_extents?: V3;
  semi_axes?: V3;
  normal?: V3;
  offset?: number;
  padding?: number;
  vertices?: V3[];
  triangles?: V3[];
}
export interface PoseJson {
  translation?: V3;
  rotation?: [number, number, number, number];
}
export interface BodyJson {
  name?: string;
  shape: number;
  pose?: PoseJson;
  motion?: { linear?: V3; angular?: V3 };
  static?: boolean;
}
export interface StepJson {
  op: "insert" | "move" | "remove" | "query";
  body?: number;
  pose?: PoseJson;
}
export interface SceneJson {
  name?: string;
  shapes: ShapeJson[];
  bodies: BodyJson[];
  script?: StepJson[];
}
export interface CertificateJson {
  kind: string;
  direction?: V3;
  offset?: number;
  point?: V3;
  rationals?: string[];
  note?: string;
  planes?: { t: number; direction: string[]; offset: string }[][];
  clear_until?: number;
  contact?: { t: string; point: string[] };
  support_pairs?: [V3, V3][];
  facets?: V3[];
}
export interface RefereeJson {
  verdict?: string;
  gap?: [unknown, unknown];
  normal?: V3;
  witness?: [V3, V3];
  verdict_certificate?: CertificateJson;
  depth_certificate?: CertificateJson;
  certificate?: CertificateJson | null;
  t_lo?: number;
  t_hi?: number;
  note?: string;
  filter_level?: number;
  overlapping_pairs?: [number, number][][];
  pairs_within?: [number, number][][];
  within?: string;
}
export interface AnswerJson {
  outcome: string;
  detail?: string;
  overlap?: boolean;
  distance?: unknown;
  witness?: [V3, V3];
  normal?: V3;
  depth?: unknown;
  manifold?: { position: V3; depth: unknown }[];
  toi?: unknown;
  lower_bound?: unknown;
  upper_bound?: unknown;
  candidate_pairs?: [number, number][][];
  contacts?: { a: number; b: number; normal: V3; depth: unknown }[];
}
export interface EngineAnswer {
  answer: AnswerJson;
  elapsed_ns: number;
  ruling: string;
  right: boolean;
  not_judged?: { claim: string; by_definition: boolean }[];
  /** The engine's own tolerance as a fraction of L, if it is wide. */
  claimed_in_l?: unknown;
  blame: string;
  undecided?: boolean;
  faults: { fault: string; words: string; error: unknown; error_in_l: unknown }[];
}
export interface QueryJson {
  question: string;
  a: number;
  b: number;
  referee: RefereeJson;
  engines: Record<string, EngineAnswer>;
}
export interface CasePage {
  page: "case";
  version: number;
  title: string;
  command: string;
  case: {
    id: string;
    description?: string;
    source?: string;
    family?: string;
    scene: SceneJson;
  };
  /** Triangles of hulls, by shape index. */
  hull_faces: Record<string, V3[]>;
  engines: Record<string, {
    library: string;
    version: string;
    settings: string;
    has_reproducer?: boolean;
    /** For an engine that is wrong: the stages of each pair, and its programs, one per question. */
    stages?: { a: number; b: number; stages: { name: string; faults: string[] }[] }[];
    programs?: { key: string; question: string; program: string }[];
  }>;
  queries: QueryJson[];
}
