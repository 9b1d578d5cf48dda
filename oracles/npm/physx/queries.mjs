// PhysX's queries about pairs: PxGeometryQuery, and PxGjkQuery with the supports of PxGjkQueryExt, whose
// generateContacts wraps proximityInfo.
import * as kit from "../adapter.mjs";
import { claim, cooking_claim, core_share, is_core, iteration_share, keep, list, pair, px, scale, shape_of, support_margin, vec } from "./library.mjs";

const gjk = px.PxGjkQuery.prototype, geometry_query = px.PxGeometryQuery.prototype;
const unlimited = 1e15; // contact distance of proximityInfo

export const query = {
  settings: "PxGeometryQuery::overlap and sweep",
  overlap({ a, b }, scene) {
    if ([a, b].every((body) => shape_of(scene, body).type === "half_space")) throw new kit.Unsupported("PhysX tests no two planes");
    const [p, at, q, there] = pair(scene, a, b);
    const overlap = geometry_query.overlap(p.geometry, at, q.geometry, there);
    return { overlap, claimed_tolerance: claim(scene, a, b, (s) => s.type === "hull") };
  },
  time_of_impact({ a, b }, scene) {
    const moved = kit.relative_translation(scene.bodies[a], scene.bodies[b]), plane = shape_of(scene, a).type === "half_space";
    if (plane && shape_of(scene, b).type === "half_space") throw new kit.Unsupported("PhysX sweeps no planes");
    const length = kit.f(Math.hypot(...moved)), [p, at, q, there] = pair(scene, a, b);
    if (length === 0) throw new kit.Unsupported("a sweep needs a direction");
    const along = vec(moved.map((c) => (plane ? -c : c) / length)), hit = keep(new px.PxSweepHit());
    const found = plane ? geometry_query.sweep(along, length, q.geometry, there, p.geometry, at, hit)
      : geometry_query.sweep(along, length, p.geometry, at, q.geometry, there, hit);
    return { toi: found ? Math.max(0, hit.distance / length) : null, claimed_tolerance: claim(scene, a, b) };
  },
};

function proximity(scene, a, b, reach) {
  const [p, at, q, there] = pair(scene, a, b), found = keep(new px.PxGjkQueryProximityInfoResult());
  if (!p.support || !q.support) throw new kit.Unsupported("PhysX has no support mapping of a plane");
  return gjk.proximityInfo(p.support, q.support, at, there, reach, scale.length, found) ? found : null;
}
const radius_of = (s) => (["sphere", "capsule"].includes(s.type) ? s.radius : 0);
// GuGjkQuery.cpp: cores about which GJK degenerates are asked again, smaller by this share.
const degenerate_share = 0.001;
function core_size(s) {
  const sizes = s.half_extents ?? s.semi_axes ?? [s.type === "capsule" || is_core(s) ? s.half_height : 0, is_core(s) ? s.radius : 0];
  return s.vertices ? Math.max(...s.vertices.map((v) => Math.hypot(...v))) : Math.hypot(...sizes);
}
function gjk_claim(scene, a, b, separation = 0) {
  const both = [a, b].map((body) => shape_of(scene, body)), sum = (of) => of(both[0]) + of(both[1]);
  return iteration_share * support_margin + core_share * Math.abs(separation + sum(radius_of))
    + degenerate_share * sum(core_size) + cooking_claim(scene, a, b);
}
const normal_of = (c) => list(c.separatingAxis).map((x) => -x);
function closest(scene, a, b, reach) {
  const c = proximity(scene, a, b, reach);
  if (!c) return { claimed_tolerance: gjk_claim(scene, a, b, reach) };
  return { distance: c.separation, point_a: list(c.pointA), point_b: list(c.pointB), normal: normal_of(c),
    claimed_tolerance: gjk_claim(scene, a, b, c.separation) };
}
export const supports = {
  settings: "PxGjkQuery::overlap, sweep and proximityInfo, toleranceLength 1",
  overlap({ a, b }, scene) {
    const [p, at, q, there] = pair(scene, a, b);
    if (!p.support || !q.support) throw new kit.Unsupported("PhysX has no support mapping of a plane");
    return { overlap: gjk.overlap(p.support, q.support, at, there), claimed_tolerance: gjk_claim(scene, a, b) };
  },
  contact({ a, b }, scene) {
    const c = proximity(scene, a, b, 0), claimed_tolerance = gjk_claim(scene, a, b, c ? c.separation : 0);
    if (!c || c.separation > 0) return { overlap: false, claimed_tolerance };
    return { overlap: true, normal: normal_of(c), depth: -c.separation, claimed_tolerance };
  },
  distance({ a, b }, scene) {
    const { normal, ...answer } = closest(scene, a, b, unlimited);
    return answer.distance === undefined ? { outcome: "not_converged", detail: "proximityInfo returned false" } : answer;
  },
  ...kit.margin_questions(closest), // PxGjkQuery.h, proximityInfo, contactDistance
  // Sweeps the second shape.
  time_of_impact({ a, b }, scene) {
    const moved = kit.relative_translation(scene.bodies[b], scene.bodies[a]), length = kit.f(Math.hypot(...moved));
    if (length === 0) throw new kit.Unsupported("a sweep needs a direction");
    const [p, at, q, there] = pair(scene, a, b), hit = keep(new px.PxGjkQuerySweepResult());
    if (!p.support || !q.support) throw new kit.Unsupported("PhysX has no support mapping of a plane");
    const found = gjk.sweep(p.support, q.support, at, there, vec(moved.map((c) => c / length)), length, hit);
    return { toi: found ? Math.max(0, hit.t / length) : null, claimed_tolerance: gjk_claim(scene, a, b) };
  },
};
