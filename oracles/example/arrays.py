#!/usr/bin/env python3
"""Spheres on NumPy arrays behind a pipe: a question about many pairs at once. See pipe_protocol.md.

    touchstone fuzz --engines 'pipe:python3 arrays.py' --cases 2000 --out out
"""
import json
import sys
import time
import numpy as np

FIELDS = {"overlap": ["overlap"], "distance": ["distance", "point_a", "point_b"],
          "contact": ["overlap", "normal", "depth"]}


def solve(question, a, b, radius_a, radius_b):
    """Of n pairs: centres n x 3, radii n. One array a field."""
    if question not in FIELDS:
        return {"outcome": np.ones(len(a))}  # TS_UNSUPPORTED
    between = b - a
    apart = np.sqrt((between * between).sum(axis=1))
    normal = np.divide(between, apart[:, None], out=np.tile([0.0, 0.0, 1.0], (len(a), 1)), where=apart[:, None] > 0)
    gap = apart - radius_a - radius_b
    every = {"overlap": gap <= 0, "distance": gap, "depth": -gap, "normal": normal,
             "point_a": a + radius_a[:, None] * normal, "point_b": b - radius_b[:, None] * normal}
    return {field: every[field] for field in FIELDS[question]}


def many(m, data):
    n, shapes = m["count"], m["shapes"]
    whole = 3 * shapes + 2 * n  # kinds, numbers of vertices and of triangles; then the shapes of a and of b
    number = np.frombuffer(data, "<i4", 2 * n, 4 * 3 * shapes).reshape(2, n)
    doubles = np.frombuffer(data, "<f8", offset=4 * (whole + whole % 2))
    radius = doubles[:4 * shapes:4]  # the first of four sizes
    a, b = doubles[4 * shapes:4 * shapes + 14 * n].reshape(2, n, 7)[:, :, :3]  # translations, without rotations
    found = solve(m["ask_many"], a, b, radius[number[0]], radius[number[1]])
    return {"answers": n, "fields": list(found)}, b"".join(np.asarray(x, "<f8").tobytes() for x in found.values())


def one(m, scene):
    if m["ask"] not in FIELDS:
        return {"outcome": "unsupported"}, b""
    bodies = [scene["bodies"][m[side]] for side in ("a", "b")]
    radii = [np.array([scene["shapes"][body["shape"]]["radius"]]) for body in bodies]
    found = solve(m["ask"], *[np.array([body["pose"]["translation"]]) for body in bodies], *radii)
    return {field: x[0].tolist() for field, x in found.items()}, b""


def say(message, numbers=b""):
    sys.stdout.buffer.write(json.dumps(message).encode() + b"\n" + numbers)
    sys.stdout.buffer.flush()


say({"touchstone_pipe": 1, "name": "arrays", "library": "mine", "version": "1", "settings": "spheres, on NumPy",
     "unit_roundoff": 2**-53, "tau_factor": 64, "source": "", "shapes": ["sphere"], "batches": True, "states_ns": True})
for line in iter(sys.stdin.buffer.readline, b""):
    m, start = json.loads(line), time.perf_counter_ns()
    if "scene" in m:
        scene = m["scene"]
        continue
    answer, numbers = many(m, sys.stdin.buffer.read(m["bytes"])) if "ask_many" in m else one(m, scene)
    say({**answer, "ns": time.perf_counter_ns() - start}, numbers)
