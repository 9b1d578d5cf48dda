#!/usr/bin/env python3
"""A broad phase behind a pipe: a box around each body, sorted and swept along x. See pipe_protocol.md.

    touchstone certify --subject 'pipe:python3 broad_phase.py'
"""
import json
import math
import sys

INF = math.inf


def reach(shape):
    """An upper bound on the distance of a point from the origin: |x| + |y| + |z| is at least the length."""
    if shape["type"] == "half_space":
        return INF
    r = shape.get("radius", 0) + shape.get("half_height", 0)
    r += sum(shape.get("half_extents", [])) + sum(shape.get("semi_axes", []))
    for v in shape.get("vertices", []):
        r = max(r, sum(abs(x) for x in v))
    return r * (1 + 2**-48)


def box_of(scene, step):
    """Rounded outward: if a bound were too small by a single bit, a pair could be lost."""
    r, t = reach(scene["shapes"][scene["bodies"][step["body"]]["shape"]]), step["pose"]["translation"]
    return [math.nextafter(x - r, -INF) for x in t], [math.nextafter(x + r, INF) for x in t]


def overlap(a, b):
    return all(a[0][k] <= b[1][k] and b[0][k] <= a[1][k] for k in (1, 2))


def pairs(present):
    """Sweep and prune: a box is compared with every box that begins before its end along x; ties count."""
    order = sorted(present.items(), key=lambda item: item[1][0][0])
    found = []
    for n, (i, a) in enumerate(order):
        for m in range(n + 1, len(order)):
            j, b = order[m]
            if b[0][0] > a[1][0]:
                break
            if overlap(a, b):
                found.append([i, j])
    return found


def candidates(scene):
    present, lists = {}, []
    for step in scene["steps"]:
        if step["op"] == "query":
            lists.append(pairs(present))
        elif step["op"] == "remove":
            del present[step["body"]]
        else:
            present[step["body"]] = box_of(scene, step)
    return {"pairs": lists}


print(json.dumps({"touchstone_pipe": 1, "name": "mine-py", "library": "mine", "version": "1",
                  "settings": "sweep and prune along x", "unit_roundoff": 1.1102230246251565e-16,
                  "tau_factor": 64, "source": "arithmetic only"}), flush=True)
scene = None
for line in sys.stdin:
    message = json.loads(line)
    if "scene" in message:
        scene = message["scene"]
    else:
        answer = candidates(scene) if message["ask"] == "candidates" else {"outcome": "unsupported"}
        print(json.dumps(answer), flush=True)
