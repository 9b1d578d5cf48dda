// Findings as packed by the program: columns of codes. Objects are created only for visible rows.
import { numberOf } from "../common/page";

export const parts = ["engine", "question", "fault", "shapes", "blame", "degeneracy", "magnitude"] as const;
export type Part = (typeof parts)[number];

export interface FindingsJson {
  count: number;
  coded: Record<Part, { values: string[]; codes: number[] }>;
  answers: number[];
  worst_in_l: unknown[];
  words: { templates: string[]; codes: number[]; numbers: string };
}

const mark = "\u0001";

export class Findings {
  readonly count: number;
  readonly answers: number[];
  readonly worst: Float64Array;
  private numbers: string[] | null = null;
  private starts = new Int32Array(0);
  private lower: string[] | null = null;

  constructor(private json: FindingsJson) {
    this.count = json.count;
    this.answers = json.answers;
    this.worst = Float64Array.from(json.worst_in_l, (x) => numberOf(x));
  }

  code = (i: number, p: Part): number => this.json.coded[p].codes[i]!;
  value = (i: number, p: Part): string => this.json.coded[p].values[this.code(i, p)]!;
  values = (p: Part): string[] => this.json.coded[p].values;
  key = (i: number): string => parts.map((p) => this.value(i, p)).join(".");

  find(key: string): number {
    for (let i = 0; i < this.count; ++i) if (key.startsWith(this.value(i, "engine")) && this.key(i) === key) return i;
    return -1;
  }

  words(i: number): string {
    const { templates, codes, numbers } = this.json.words;
    if (!this.numbers) {
      this.numbers = numbers.split(" ");
      const many = templates.map((t) => t.split(mark).length - 1);
      this.starts = new Int32Array(this.count + 1);
      for (let k = 0; k < this.count; ++k) this.starts[k + 1] = this.starts[k]! + many[codes[k]!]!;
    }
    let next = this.starts[i]!;
    return templates[codes[i]!]!.replaceAll(mark, () => this.numbers![next++]!);
  }

  says(i: number, lowercase: string): boolean {
    this.lower ??= Array.from({ length: this.count }, (_, k) => this.words(k).toLowerCase());
    return this.lower[i]!.includes(lowercase);
  }
}

export interface Group {
  id: string;
  rows: number[];
  answers: number;
  worst: number;
}

/** Groups the rows by the given parts, in the order of each group's first row. */
export function groupsOf(f: Findings, rows: number[], by: readonly Part[]): Group[] {
  const groups = new Map<number, Group>();
  for (const i of rows) {
    let code = 0;
    for (const p of by) code = code * f.values(p).length + f.code(i, p);
    let g = groups.get(code);
    if (!g) groups.set(code, (g = { id: by.map((p) => f.value(i, p)).join("."), rows: [], answers: 0, worst: 0 }));
    g.rows.push(i);
    g.answers += f.answers[i]!;
    if (!(f.worst[i]! <= g.worst)) g.worst = f.worst[i]!;
  }
  return [...groups.values()];
}
