"""Checks another engine's Python interface: here a distance of two boxes that forgets that boxes can be turned."""
import numpy as np

import touchstone


def engine_distance(half_a, half_b, pose_b):
    """The interface to check. Replace it by that of your engine."""
    apart = np.abs(pose_b[:, :3]) - half_a - half_b
    return np.linalg.norm(np.maximum(apart, 0), axis=1)


rng = np.random.default_rng(1)
poses = np.hstack([rng.uniform(3, 6, (1000, 3)), rng.normal(size=(1000, 4))])
says = engine_distance(np.ones(3), np.ones(3), poses)
a, b = touchstone.body("box 1 1 1"), touchstone.body("box 1 1 1", poses)
wrong = np.flatnonzero(touchstone.judge(a, b, distance=says) == touchstone.WRONG)
print(f"{len(wrong)} of {len(says)} distances are wrong; the first:")
print(touchstone.explain(a, touchstone.body("box 1 1 1", poses[wrong[0]]), distance=says[wrong[0]])["faults"][0]["words"])
