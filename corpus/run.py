#!/usr/bin/env python3
"""Asks an engine the cases of this corpus and says which of its answers are wrong. Needs Python alone.

    import run                                  # or, for answers in a file: python3 run.py ANSWERS.jsonl [--json]
    def engine(case, question):                 # case["a"] and case["b"]: shape, pose, motion (README.md)
        return {"overlap": True, "normal": [0, 0, 1], "depth": 0.25}     # None: the engine has no such question
    run.report(run.run(engine))
"""
import glob, json, math, os, sys

HERE = os.path.dirname(os.path.abspath(__file__))

def cases(directory=HERE):
    for file in sorted(glob.glob(os.path.join(directory, "cases", "*.json"))):
        with open(file, encoding="utf-8") as f:
            yield from json.load(f)["cases"]

def unturned(body, v):  # v in the frame of the body
    x, y, z, w = body.get("pose", {}).get("rotation", [0, 0, 0, 1])
    m = max(abs(x), abs(y), abs(z), abs(w))
    x, y, z, w = -x / m, -y / m, -z / m, w / m
    u, d = x * x + y * y + z * z, 2 * (x * v[0] + y * v[1] + z * v[2])
    c = y * v[2] - z * v[1], z * v[0] - x * v[2], x * v[1] - y * v[0]
    return [(d * q + (w * w - u) * e + 2 * w * k) / (u + w * w) for q, e, k in zip((x, y, z), v, c)]

def support(body, direction):  # the largest direction . x of the body, placed at the origin
    s, n = body["shape"], unturned(body, direction)
    kind, h, r, side = s["type"], s.get("half_height", 0), s.get("radius", 0), math.hypot(n[0], n[1])
    if kind == "cylinder": return abs(n[2]) * h + r * side
    if kind == "cone": return max(n[2] * h, r * side - n[2] * h)
    if kind == "ellipsoid": return math.hypot(*(c * e for c, e in zip(n, s["semi_axes"])))
    if kind == "hull": return max(sum(c * x for c, x in zip(n, v)) for v in s["vertices"])
    core = sum(abs(c) * e for c, e in zip(n, s.get("half_extents", [0, 0, h])))
    return core + (r * math.hypot(*n) if r else 0)  # sphere, box, capsule, rounded_box

def width(case, n):  # how far B must move along n to leave A
    a, b = (case[k].get("pose", {}).get("translation", [0, 0, 0]) for k in "ab")
    w = support(case["a"], n) + support(case["b"], [-c for c in n])
    return (w - sum(c * (y - x) for c, x, y in zip(n, a, b))) / math.hypot(*n)

def motion_fault(case, t, tau, skin):
    truth = case["truth"]
    late, early = ([r for r in truth["right_times"] if x <= 2.0**-r[0] * case["scale"]] for x in (tau, tau + skin))
    if not early or not late: return "not judged"
    if t is None: return "missed" if truth["deepest"] > 2.0**-late[0][0] * case["scale"] else None
    if not 0 <= float(t) <= 1: return "not a time"
    if len(early[0]) < 2 or float(t) < early[0][1]: return "early"
    return "late" if float(t) > (late[0] + [1, 1])[2] else None

def fault(case, question, answer, limits=None):  # None if right
    u = 64 * 2.0**-53
    limits = {"tau": u * case["scale"], "unit": u, "offset": 0, "skin": 0, "bias": 0, **(limits or {})}
    tau, offset = limits["tau"], limits["offset"]
    if question == "time_of_impact": return motion_fault(case, answer["time_of_impact"], tau, limits["skin"])
    (low, high), says = case["truth"]["gap"], answer.get("overlap")
    ok = "not judged" if max(tau, 0 if question == "distance" else offset) >= case["scale"] else None
    if says is None and (question != "distance" or "distance" not in answer): return "no number"
    if says is True and low > tau + offset: return "ghost"
    if says is False and -high > tau: return "missed"
    if question == "distance" and "distance" in answer:
        return ok if low - tau <= float(answer["distance"]) <= high + tau else "distance off"
    if question != "contact" or not says: return ok
    n, depth = [float(c) for c in answer.get("normal", [])], answer.get("depth")
    if n and not abs(math.hypot(*n) - 1) <= limits["unit"]: return "normal not of length 1"
    near = offset > 0 and low > 0
    least = (-high, -low) if near else (max(0, -high), max(0, -low))
    if n:
        w = width(case, n)
        if w - least[1] > tau + limits["bias"] * max(0, least[0]): return "not the least depth"
        least = least[0] if w - least[1] <= tau else w, w if near else max(0, w)
    return ok if depth is None or least[0] - tau <= float(depth) <= least[1] + tau else "depth off"

def run(engine, directory=HERE, limits=None):  # yields case, question, result
    for case in cases(directory):
        for question in case["questions"]:
            try:
                answer = engine(case, question)
            except Exception as e:
                yield case, question, "failed: %s" % e
                continue
            why = "unsupported" if answer is None else fault(case, question, answer, answer.get("limits", limits))
            yield case, question, why if why in ("unsupported", "not judged") else "wrong: " + why if why else "right"

def report(results):
    count = {}
    for case, question, result in results:
        for flag in ["all", question, case["flags"]["size"], case["flags"]["mechanism"]] + case["flags"]["degeneracy"]:
            count.setdefault(flag, {}).setdefault(result.split(":")[0], []).append(case["id"])
    for flag in count:
        print("%-22s" % flag, "  ".join("%s %d" % (r, len(ids)) for r, ids in sorted(count[flag].items())))

if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as f:
        given = {(j["case"], j["question"]): j for j in map(json.loads, f)}
    def recorded(case, question):
        j = given.get((case["id"], question), {})
        if "failed" in j: raise RuntimeError(j["failed"])
        return {**j["answer"], "limits": j.get("limits")} if "answer" in j else None
    if "--json" in sys.argv: print(json.dumps([[c["id"], q, r.split(":")[0]] for c, q, r in run(recorded)]))
    else: report(run(recorded))
