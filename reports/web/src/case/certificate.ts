// The referee's certificates in a drawable form, rounded from their exact numbers.
import { numberOf } from "../common/page";
import type { CertificateJson, RefereeJson, V3 } from "./types";

/** "n/d" with integers of any length. */
export function rational(text: string): number {
  const [n, d] = text.split("/");
  if (!d) return Number(n);
  // Both are shifted to at most about 1,000 bits: enough for a double, without overflow.
  const numerator = BigInt(n!), denominator = BigInt(d);
  const drop = BigInt(Math.max(0, denominator.toString(2).length - 1000, numerator.toString(2).length - 1000));
  return Number(numerator >> drop) / Number(denominator >> drop);
}

export type Drawn =
  | { kind: "plane"; normal: V3; offset: number; words: string }
  | { kind: "point"; at: V3; words: string }
  | { kind: "segment"; from: V3; to: V3; words: string }
  | { kind: "polytope"; edges: [V3, V3][]; words: string }
  | { kind: "direction"; along: V3; depth: number; words: string };

const unit = (v: V3): [V3, number] => {
  const n = Math.hypot(...v);
  return [[v[0] / n, v[1] / n, v[2] / n], n];
};

function drawnVerdict(c: CertificateJson): Drawn[] {
  if (c.kind === "separating_plane") {
    const r = c.rationals?.map(rational);
    const direction: V3 = r ? [r[0]!, r[1]!, r[2]!] : c.direction!;
    const offset = r ? r[3]! : c.offset!;
    const [n, length] = unit(direction);
    const more = r && r.length > 4 ? ` (the first of ${Math.floor(r.length / 4)} planes, one per triangle)` : "";
    return [{ kind: "plane", normal: n, offset: offset / length, words: `a plane that separates A and B${more}` }];
  }
  if (c.kind === "common_point") {
    const at = (c.rationals?.slice(0, 3).map(rational) ?? c.point) as V3;
    return [{ kind: "point", at, words: "a point in both bodies" }];
  }
  return [];
}

// The polytope lies in A − B, which is hard to draw. Each vertex is a point of A minus a point of B; connecting the
// points of A, and those of B, along the facets' edges gives polytopes inside the two bodies.
function drawnPolytope(c: CertificateJson): Drawn[] {
  const pairs = c.support_pairs ?? [], seen = new Set<string>();
  const edges: [V3, V3][] = [];
  for (const f of c.facets ?? [])
    for (let k = 0; k < 3; ++k)
      for (const body of [0, 1] as const) {
        const from = pairs[f[k]!]?.[body], to = pairs[f[(k + 1) % 3]!]?.[body];
        if (!from || !to || from.every((x, i) => x === to[i])) continue;
        const key = [from.join(), to.join()].sort().join(";");
        if (seen.has(key)) continue;
        seen.add(key);
        edges.push([from, to]);
      }
  return edges.length ? [{ kind: "polytope", edges, words: `the ${pairs.length} points of A and of B that prove the depth, as polytopes inside the bodies` }] : [];
}

// Moving planes, given in the frame that travels with B: x = x_world − (B's translation at t).
function drawnImpact(c: CertificateJson, t: number, originOfB: V3): Drawn[] {
  const out: Drawn[] = [];
  for (const track of c.planes ?? []) {
    if (out.length >= 8 || t > (c.clear_until ?? 0)) break;
    const i = track.findIndex((k, j) => j + 1 < track.length && k.t <= t && t <= track[j + 1]!.t);
    if (i < 0) continue;
    const from = track[i]!, to = track[i + 1]!;
    const s = to.t > from.t ? (t - from.t) / (to.t - from.t) : 0;
    const mix = (a: string, b: string): number => (1 - s) * rational(a) + s * rational(b);
    const [n, length] = unit([0, 1, 2].map((k) => mix(from.direction[k]!, to.direction[k]!)) as V3);
    const offset = mix(from.offset, to.offset) / length + n[0] * originOfB[0] + n[1] * originOfB[1] + n[2] * originOfB[2];
    out.push({ kind: "plane", normal: n, offset, words: `moving planes that separate the bodies until t = ${c.clear_until}` });
  }
  if (c.contact && Math.abs(rational(c.contact.t) - t) < 2e-3)
    out.push({
      kind: "point",
      at: c.contact.point.map((x, k) => rational(x) + originOfB[k]!) as V3,
      words: `a point in both bodies at t = ${rational(c.contact.t)}`,
    });
  return out;
}

export function drawn(r: RefereeJson, question: string, t: number, originOfB: V3): Drawn[] {
  if (question === "time_of_impact" || question === "ray") return r.certificate ? drawnImpact(r.certificate, t, originOfB) : [];
  const out: Drawn[] = r.verdict_certificate ? drawnVerdict(r.verdict_certificate) : [];
  const gap = numberOf(r.gap?.[0]);
  if (r.verdict === "disjoint" && gap > 0 && r.witness && question !== "overlap")
    out.push({ kind: "segment", from: r.witness[0], to: r.witness[1], words: "the closest points" });
  if ((question === "contact" || question === "contact_within") && r.depth_certificate) out.push(...drawnPolytope(r.depth_certificate));
  const depth = r.gap ? -numberOf(r.gap[1]) : NaN;
  if (r.verdict === "overlap" && Number.isFinite(gap) && Number.isFinite(depth) && r.normal)
    out.push({ kind: "direction", along: r.normal, depth, words: "the direction of least depth: moving B this far along it separates the bodies" });
  return out;
}
