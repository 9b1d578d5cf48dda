#!/usr/bin/env python3
"""Judges accusations of `touchstone fuzz --out DIR` a second time, in exact arithmetic and from docs/truth.md alone.

    second_judge.py --touchstone PROGRAM [--number N] [--seed S] DIR       accusations, drawn evenly over engine and fault
    second_judge.py --touchstone PROGRAM --campaign CASES [...]            the same for a small campaign of its own
    second_judge.py --touchstone PROGRAM --let-off [...] CASE-OR-DIR ...   answers that `replay` counts as right

Every error of an answer is bracketed, [lo, hi], by rational certificates. An accusation is *confirmed* when lo > tau for the
fault it names, *refuted* (false) when hi <= tau, otherwise *cannot tell*. An answer is let off when it counts as right although
lo > tau for some error. Exit code: 0 none false and none let off, 1 some are, 2 bad usage, 3 nothing was judged.
This program shares no code with the referee or the judge, and was written without reading them.
"""
import argparse
import collections
import json
import math
import os
import random
import signal
import subprocess
import sys
import tempfile
from fractions import Fraction as F

from exact import Poly, dot, exact, sqrt_hi, sqrt_lo, sub
from scene import CannotTell, FAR, HalfSpace, Mesh, distance_to, needed, scale, signed_gap, world

OUTCOMES = ("crashed", "threw", "timed_out", "failed", "unstable", "not_converged", "invalid_input", "relation", "slow")


def numbers(x):
    """JSON has no NaN and no infinity: they are stored as text."""
    if isinstance(x, dict):
        return {k: numbers(v) for k, v in x.items()}
    if isinstance(x, list):
        return [numbers(v) for v in x]
    return float(x) if isinstance(x, str) and x.lower().lstrip("+-") in ("nan", "inf", "infinity") else x


def finite(v):
    return v is not None and all(isinstance(x, (int, float)) and math.isfinite(x) for x in v)


def off(bracket, value):
    """Bracket of |value - x|, x in the bracket."""
    lo, hi = value - bracket[1], value - bracket[0]
    return (F(0) if lo <= 0 <= hi else min(abs(lo), abs(hi))), max(abs(lo), abs(hi))


def largest(brackets):
    brackets = list(brackets)
    return max(b[0] for b in brackets), max(b[1] for b in brackets)


def length(v):
    q = dot(v, v)
    return sqrt_lo(q), sqrt_hi(q)


class Pair:
    """Two bodies at rest; the gap is computed on demand. tau: of the answer, 0 if it does not matter."""

    def __init__(self, a, b, hints=(), tau=F(0)):
        self.a, self.b, self.hints, self.known, self.tau = a, b, list(hints), None, tau

    @property
    def gap(self):
        if self.known is None:
            self.known = signed_gap(self.a, self.b, self.hints)
        return self.known

    def surface(self):
        return isinstance(self.a, Mesh) or isinstance(self.b, Mesh)


def verdict_errors(pair, says):
    lo, hi = pair.gap
    if says:
        return {"ghost": (lo, hi)}
    if pair.surface() and lo < 0:
        lo = -FAR  # the depth in one triangle is the least that it can be
    return {"missed": (-hi, -lo)}


def within_errors(pair, margin, says):
    lo, hi = pair.gap
    if says:
        return {"ghost": (lo - margin, hi - margin)}
    if pair.surface() and lo < 0:
        if margin < 0:
            raise CannotTell("the depth of a surface is not defined")
        lo = -FAR
    return {"missed": (margin - hi, margin - lo)}


def bound_errors(pair, answer):
    found = {}
    lo, hi = pair.gap
    lower, upper = answer.get("lower_bound"), answer.get("upper_bound")
    if lower is not None and math.isfinite(lower):
        found["bound_off"] = (F(lower) - hi, F(lower) - lo)
    if upper is not None and math.isfinite(upper) and not (pair.surface() and lo < 0):
        found["bound_off"] = largest([found.get("bound_off", (-FAR, -FAR)), (lo - F(upper), hi - F(upper))])
    return found


def witness_errors(pair, points):
    if not (finite(points[0]) and finite(points[1])):
        return {"witness_off": (FAR, FAR)}
    p, q = exact(points[0]), exact(points[1])
    parts = [distance_to(p, pair.a), distance_to(q, pair.b)]
    lo, hi = pair.gap
    if not (pair.surface() and lo < 0):
        g = off((lo, hi), F(0))
        apart = length(sub(q, p))
        parts.append((max(apart[0] - g[1], g[0] - apart[1], F(0)), max(apart[1] - g[0], g[1] - apart[0])))
    return {"witness_off": largest(parts)}


def distance_errors(pair, answer):
    found = {}
    d = answer.get("distance")
    if d is not None and not math.isfinite(d):
        return {"distance_off": (FAR, FAR)}
    if d is not None and pair.surface() and pair.gap[0] < 0:
        if d > 0:
            found["distance_off"] = (F(d) - max(pair.gap[1], F(0)), FAR)  # the signed gap of a surface that overlaps is at most 0
    elif d is not None:
        found["distance_off"] = off(pair.gap, F(d))
    says = answer.get("overlap") if d is None else d <= 0
    if says is not None and not d == 0:
        found.update(verdict_errors(pair, says))
    if answer.get("witness"):
        found.update(witness_errors(pair, answer["witness"]))
    return found


def normal_errors(pair, normal, depth, apart=False):
    """Judges a reported normal and depth; the depth may be absent. apart: of bodies within a margin, with a negative depth."""
    if not finite(normal) or not any(normal):
        return {"normal_not_unit": (FAR, FAR)}
    n = exact(normal)
    lo, hi = length(n)
    found = {"normal_not_unit": off((lo, hi), F(1))}
    w = needed(pair.a, pair.b, n)
    if w is None:
        found["not_minimal"] = (FAR, FAR)
        return found
    solid = not pair.surface() or pair.gap[0] >= 0
    if depth is not None and not math.isfinite(depth):
        return {**found, "infeasible": (FAR, FAR)}
    if solid:
        least = (-pair.gap[1], -pair.gap[0]) if apart else (max(-pair.gap[1], F(0)), max(-pair.gap[0], F(0)))
        found["not_minimal"] = (w[0] - least[1], w[1] - least[0])
    if depth is not None:
        found["depth_excess"] = (F(depth) - w[1], F(depth) - w[0])
        if solid:  # beside a normal that is right, a depth is compared with the least one
            due = least if w[0] - least[1] <= pair.tau else w
            found["infeasible"] = (due[0] - F(depth), due[1] - F(depth))
        elif depth < 0:
            found["infeasible"] = (F(-depth), F(-depth))
    return found


def point_errors(pair, points, depth):
    inflated = lambda p: max(F(d) for d in (0, depth, p.get("depth")) if d is not None and math.isfinite(d))
    if not all(finite(p["position"]) for p in points):
        return {"point_off": (FAR, FAR)}
    parts = [[x - inflated(p) for x in distance_to(exact(p["position"]), s)] for p in points for s in (pair.a, pair.b)]
    return {"point_off": largest(parts)} if parts else {}


def contact_errors(pair, answer):
    says = answer.get("overlap")
    found = verdict_errors(pair, says) if says is not None else {}
    if says is False:
        return found
    if answer.get("normal") is not None:
        found.update(normal_errors(pair, answer["normal"], answer.get("depth")))
    found.update(point_errors(pair, answer.get("manifold", []), answer.get("depth")))
    depths = [p["depth"] for p in answer.get("manifold", []) if p.get("depth") is not None and math.isfinite(p["depth"])]
    if depths and finite(answer.get("normal")) and any(answer["normal"]):
        w = needed(pair.a, pair.b, exact(answer["normal"]))
        found["point_depth"] = (F(max(depths)) - w[1] if w else -FAR, FAR)  # the depth on its own line is not asked here
    if answer.get("depth") is not None and pair.gap[1] < 0 and answer.get("normal") is None and not pair.surface():
        found["depth_off"] = off((-pair.gap[1], -pair.gap[0]), F(answer["depth"]))
    return found


def near_contact_errors(pair, margin, answer):
    """A contact of bodies that may be apart by the margin. Where they are, a point lies within their distance there of both, or
    within the margin."""
    found = within_errors(pair, margin, answer["overlap"])
    if not answer["overlap"]:
        return found
    if pair.gap[0] <= 0:
        return {**contact_errors(pair, {**answer, "overlap": None}), **found}
    depth = answer.get("depth")
    if pair.surface():
        if depth is not None and math.isfinite(depth):
            found["infeasible"] = (-pair.gap[1] - F(depth), -pair.gap[0] - F(depth))
            found["depth_excess"] = (F(depth) + pair.gap[0], F(depth) + pair.gap[1])
    elif answer.get("normal") is not None:
        found.update(normal_errors(pair, answer["normal"], depth, apart=True))
    within = lambda d: d if d is None or d >= 0 else min(-d, max(float(margin), 0))
    points = [{**p, "depth": within(p.get("depth"))} for p in answer.get("manifold", [])]
    of_contact = depth if depth is not None and math.isfinite(depth) else 0
    found.update(point_errors(pair, points, max(of_contact, float(pair.gap[1]))))
    return found


def scene_contact_errors(scene, a, b, answer):
    mine = [c for c in answer.get("contacts", []) if {c["a"], c["b"]} == {a, b}]
    if not mine:
        return verdict_errors(Pair(world(scene, a), world(scene, b)), False)
    deepest = max(mine, key=lambda c: c["depth"] if math.isfinite(c["depth"]) else math.inf)
    found = {}
    for c in mine:
        pair = Pair(world(scene, c["a"]), world(scene, c["b"]))
        for fault, e in {**verdict_errors(pair, True), **normal_errors(pair, c["normal"], c["depth"])}.items():
            if fault == "infeasible" and c is not deepest:
                continue
            found[fault] = max(found.get(fault, e), e)
    return found


def deepest(scene, a, b, until, tau, times):
    """Bracket of the largest depth up to a time: what samples prove below, nothing above."""
    best = -FAR
    pair_depth = lambda t: -signed_gap(world(scene, a, t), world(scene, b, t))[1]
    for t in [t for t in times if 0 <= t <= until] + [until * F(i, 16) for i in range(16, -1, -1)]:
        best = max(best, pair_depth(t))
        if best > tau:
            break
    return best, FAR


def impact_errors(scene, a, b, answer, tau, certificate):
    toi = answer.get("toi")
    hints = []
    if certificate.get("kind") == "impact":
        t = F((certificate.get("contact") or {}).get("t", certificate.get("clear_until", 0)))
        hints = [min(F(1), t + d) for d in (F(0), F(1, 1000), F(1, 100), F(1, 20))]
    if toi is None:
        return {"missed": deepest(scene, a, b, F(1), tau, hints)}
    if not math.isfinite(toi):
        return {"early": (FAR, FAR)}
    t = F(toi)
    early = signed_gap(world(scene, a, t), world(scene, b, t))
    return {"early": early, "ghost": (early[0], FAR) if early[0] <= tau else early, "late": deepest(scene, a, b, t, tau, [t] + hints)}


def live_poses(scene, k):
    """Bodies with their poses at the k-th query of the script."""
    steps = scene.get("script") or [{"op": "insert", "body": i} for i in range(len(scene["bodies"]))] + [{"op": "query"}]
    live = {}
    for s in steps:
        if s["op"] == "query":
            if k == 0:
                return live
            k -= 1
        elif s["op"] == "remove":
            del live[s["body"]]
        else:
            live[s["body"]] = s.get("pose", scene["bodies"][s["body"]].get("pose", {}))
    raise CannotTell("the script has fewer queries")


def candidate_errors(scene, certificate, answer):
    """Missed and stale pairs of a broad phase, without tolerance: 1 if there is one, else 0."""
    queries = answer.get("pairs")
    if queries is None:
        raise CannotTell("the pairs are not stored")
    if queries and queries[0] and isinstance(queries[0][0], int):
        queries = [queries]
    stale = sum(1 for k, pairs in enumerate(queries) for p in pairs if not set(p) <= set(live_poses(scene, k)))
    found = {"stale": (F(stale), F(stale))}
    a, b = (certificate.get("bodies") or [None, None])[:2]
    if a is None:
        return found
    lost = (F(0), F(0))
    for k, pairs in enumerate(queries):
        live = live_poses(scene, k)
        if a in live and b in live and [a, b] not in pairs and [b, a] not in pairs:
            lo, hi = signed_gap(world(scene, a, pose=live[a]), world(scene, b, pose=live[b]), deep=False)
            lost = max(lost, (F(1 if hi <= 0 else 0), F(0 if lo > 0 else 1)))
    found["missed"] = lost
    return found


def errors(scene, question, a, b, answer, tau, certificate):
    if question == "candidates":
        return candidate_errors(scene, certificate, answer)
    if question == "time_of_impact":
        return impact_errors(scene, a, b, answer, tau, certificate)
    if question in ("ray", "candidates_within"):
        raise CannotTell(f"{question} is not judged here")
    if question == "scene_contacts":
        return scene_contact_errors(scene, a, b, answer)
    hint = certificate.get("direction")
    hints = [[F(x) for x in hint]] if hint else []
    if hints:
        hints.append([-x for x in hints[0]])
    if answer.get("normal") and finite(answer["normal"]):
        hints.append(answer["normal"])
    pair = Pair(world(scene, a), world(scene, b), hints, tau)
    if question == "overlap":
        return verdict_errors(pair, answer["overlap"])
    if question == "within":
        return within_errors(pair, F(scene.get("margin", 0)), answer["overlap"])
    if question == "contact_within":
        return near_contact_errors(pair, F(scene.get("margin", 0)), answer)
    if question == "bounded_distance":
        return distance_errors(pair, answer) | bound_errors(pair, answer)
    return (distance_errors if question == "distance" else contact_errors)(pair, answer)


class Judge:
    def __init__(self, program, seconds):
        self.program, self.seconds = program, seconds
        text = subprocess.run([program, "engines", "--json"], capture_output=True, text=True, check=True).stdout
        self.cards = {c["name"]: c for c in json.loads(text)}

    def tau(self, engine, scene, a, b, answer):
        card = self.cards[engine]
        claim = answer.get("claimed_tolerance") or 0
        if not card.get("source") or not math.isfinite(claim) or claim < 0:
            claim = 0
        return F(card["unit_roundoff"]) * F(card["tau_factor"]) * (scale(scene, a, b) + F(claim)) + F(claim)

    def bounded(self, work):
        """(result, None) or (None, reason), within the CPU seconds granted."""
        def stop(*_):
            raise CannotTell(f"not decided within {self.seconds} CPU seconds")
        signal.signal(signal.SIGPROF, stop)
        signal.setitimer(signal.ITIMER_PROF, self.seconds)
        try:
            return work(), None
        except CannotTell as e:
            return None, str(e)
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)

    def all_errors(self, engine, scene, question, a, b, answer, certificate):
        tau = F(0) if question == "candidates" else self.tau(engine, scene, a, b, answer)
        return tau, errors(scene, question, a, b, answer, tau, certificate)

    def accusation(self, folder):
        """(verdict, words, finding)."""
        with open(os.path.join(folder, "finding.json")) as f:
            finding = json.load(f)
        with open(os.path.join(folder, "case.json")) as f:
            case = json.load(f)
        if finding["engine"] not in self.cards:
            return "cannot tell", "no such engine", finding
        certificate = finding.get("certificate") or {}
        query = next(q for q in case["queries"] if q["question"] == finding["question"])
        a, b = certificate.get("bodies") or (query.get("a"), query.get("b"))  # a case may ask several pairs
        if a is None and finding["question"] == "scene_contacts":
            odd = max(numbers(finding["observation"])["contacts"], key=lambda c: abs(math.hypot(*c["normal"]) - 1) if finite(c["normal"]) else math.inf)
            a, b = odd["a"], odd["b"]
        if a is None and finding["question"] != "candidates":
            return "cannot tell", "the pair is not named", finding
        result, why = self.bounded(lambda: self.all_errors(
            finding["engine"], case["scene"], finding["question"], a, b, numbers(finding["observation"]), certificate))
        if result is None:
            return "cannot tell", why, finding
        tau, found = result
        if finding["fault"] not in found:
            return "cannot tell", f"not judged here: {finding['fault']} (found {', '.join(found)})", finding
        lo, hi = found[finding["fault"]]
        if finding["fault"] == "normal_not_unit":
            tau = F(self.cards[finding["engine"]]["unit_roundoff"] * self.cards[finding["engine"]]["tau_factor"])
        words = f"error in [{rough(lo)}, {rough(hi)}], tau {rough(tau)}"
        return ("confirmed" if lo > tau else "refuted" if hi <= tau else "cannot tell"), words, finding


def rough(x):
    return "%.9g" % float(x) if abs(x) < F(10) ** 300 else ("inf" if x > 0 else "-inf")


def kind_of(folder):
    return tuple(os.path.basename(folder).split(".")[:3])


def draw(folders, number, seed):
    """Draws evenly over engine x question x fault, at random within each."""
    heaps = collections.defaultdict(list)
    for f in sorted(folders):
        if not kind_of(f)[-1].startswith(OUTCOMES):
            heaps[kind_of(f)].append(f)
    r, drawn = random.Random(seed), []
    for h in heaps.values():
        r.shuffle(h)
    while len(drawn) < number and any(heaps.values()):
        drawn += [heaps[k].pop() for k in sorted(heaps) if heaps[k]]
    return drawn[:number]


def table(counts, columns):
    width = max(len(" ".join(k)) for k in counts)
    print(f"{'':{width}} " + " ".join(f"{c:>12}" for c in columns))
    for k in sorted(counts):
        print(f"{' '.join(k):{width}} " + " ".join(f"{counts[k][c]:12}" for c in columns))
    print(f"{'all':{width}} " + " ".join(f"{sum(v[c] for v in counts.values()):12}" for c in columns))


def judge_accusations(judge, options):
    root = os.path.join(options.paths[0], "findings")
    folders = [os.path.join(root, f) for f in os.listdir(root)]
    counts, refuted = collections.defaultdict(collections.Counter), 0
    for folder in draw(folders, options.number, options.seed):
        verdict, words, finding = judge.accusation(folder)
        counts[(finding["engine"], finding["question"], finding["fault"])][verdict] += 1
        refuted += verdict == "refuted"
        if verdict != "confirmed" or options.verbose:
            print(f"{verdict}: {folder}\n  accused: {finding['words']}\n  here: {words}; blame {finding['blame']}", flush=True)
    if not counts:
        print("no accusation to judge", file=sys.stderr)
        return 3
    table(counts, ("confirmed", "refuted", "cannot tell"))
    return 1 if refuted else 0


def judge_let_offs(judge, options):
    """For every right answer of the cases: is one of its errors certainly above tau?"""
    counts, let_off = collections.defaultdict(collections.Counter), 0
    files = [p if os.path.isfile(p) else os.path.join(p, "findings", f, "case.json")
             for p in options.paths for f in ([""] if os.path.isfile(p) else sorted(os.listdir(os.path.join(p, "findings"))))]
    random.Random(options.seed).shuffle(files)
    seen = set()
    for path in files:
        with open(path) as f:
            case = json.load(f)
        text = json.dumps(case.get("scene"))
        if text in seen or sum(v["right"] for c in counts.values() for v in [c]) >= options.number:
            continue
        seen.add(text)
        run = subprocess.run([judge.program, "replay", "--json", path], capture_output=True, text=True)
        if run.returncode not in (0, 1, 3) or not run.stdout.strip():
            continue
        for query in json.loads(run.stdout)[0]["queries"]:
            if query["question"] not in ("overlap", "distance", "contact", "time_of_impact", "within", "bounded_distance", "contact_within"):
                continue
            for engine, e in query["engines"].items():
                if not e["right"] or e["answer"].get("outcome") != "answered":
                    continue
                result, why = judge.bounded(lambda: judge.all_errors(
                    engine, case["scene"], query["question"], query["a"], query["b"], numbers(e["answer"]), {}))
                key = (engine, query["question"])
                if result is None:
                    counts[key]["cannot tell"] += 1
                    continue
                tau, found = result
                wrong = [(k, b) for k, b in found.items() if b[0] > tau and k not in ("normal_not_unit", "depth_off")]
                counts[key]["let off" if wrong else "right"] += 1
                let_off += bool(wrong)
                for k, b in wrong:
                    print(f"let off: {path} {engine} {query['question']}: {k} error in [{rough(b[0])}, {rough(b[1])}], tau {rough(tau)}", flush=True)
    if not counts:
        print("no answer to judge", file=sys.stderr)
        return 3
    table(counts, ("right", "let off", "cannot tell"))
    return 1 if let_off else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--touchstone", required=True, help="the program, for cards and replay")
    parser.add_argument("--number", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=20, help="CPU seconds granted to each accusation")
    parser.add_argument("--let-off", action="store_true")
    parser.add_argument("--campaign", type=int, default=0)
    parser.add_argument("--verbose", action="store_true")
    parser.add_argument("paths", nargs="*")
    options = parser.parse_args()
    if bool(options.paths) == bool(options.campaign):
        parser.error("a directory, cases, or --campaign")
    judge = Judge(options.touchstone, options.seconds)
    if options.campaign:
        with tempfile.TemporaryDirectory() as out:
            options.paths = [out]
            run = subprocess.run([options.touchstone, "fuzz", "--cases", str(options.campaign), "--seed", str(options.seed),
                                  "--out", out], stdout=subprocess.DEVNULL)
            if run.returncode not in (0, 1, 3):
                return 3
            return judge_accusations(judge, options)
    return (judge_let_offs if options.let_off else judge_accusations)(judge, options)


if __name__ == "__main__":
    sys.exit(main())
