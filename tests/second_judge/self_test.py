"""The second judge on accusations with known answers, including false ones."""
import json
import math
import os
import tempfile
import unittest
from fractions import Fraction as F

from exact import Poly, sqrt_hi, sqrt_lo
from scene import scale, signed_gap, world
from second_judge import Judge

SHAPES = {
    "box": {"type": "box", "half_extents": [1, 1, 1]},
    "ball": {"type": "sphere", "radius": 1},
    "rounded": {"type": "rounded_box", "half_extents": [1, 1, 1], "radius": 0.5},
    "cylinder": {"type": "cylinder", "radius": 1, "half_height": 1},
    "cone": {"type": "cone", "radius": 1, "half_height": 1},
    "ellipsoid": {"type": "ellipsoid", "semi_axes": [1, 1, 1]},
    "padded": {"type": "padded_cylinder", "radius": 1, "half_height": 1, "padding": 0.5},
    "padded cone": {"type": "padded_cone", "radius": 1, "half_height": 1, "padding": 0.5},
    "padded ellipsoid": {"type": "padded_ellipsoid", "semi_axes": [1, 1, 1], "padding": 0.5},
    "floor": {"type": "half_space", "normal": [0, 0, 2], "offset": -2},
    "triangle": {"type": "mesh", "vertices": [[-9, -9, 0], [9, -9, 0], [0, 9, 0]], "triangles": [[0, 1, 2]]},
}


def scene(a, b, x, motion=None):
    body = {"shape": 1, "pose": {"translation": x}}
    return {"shapes": [SHAPES[a], SHAPES[b]], "bodies": [{"shape": 0}, dict(body, motion=motion) if motion else body]}


class SecondJudge(unittest.TestCase):
    def gap_is(self, a, b, x, expected, within=1e-12):
        s = scene(a, b, x)
        lo, hi = signed_gap(world(s, 0), world(s, 1))
        self.assertLessEqual(lo, hi)
        self.assertLess(abs(float(lo) - expected), within)
        self.assertLess(abs(float(hi) - expected), within)

    def test_gaps(self):
        self.gap_is("box", "box", [2.5, 0, 0], 0.5)
        self.gap_is("box", "box", [1.5, 0.25, 0], -0.5)
        self.gap_is("box", "box", [0, 0, 0], -2)
        self.gap_is("ball", "ball", [3, 4, 0], 3)
        self.gap_is("ball", "ball", [0, 0, 0], -2)
        self.gap_is("floor", "box", [0, 0, 0.5], 0.5)
        self.gap_is("floor", "cone", [0, 0, -1], -1)
        self.gap_is("rounded", "ball", [4, 5, 0], 3.5)
        self.gap_is("rounded", "rounded", [2.5, 0, 0], -0.5)
        self.gap_is("cylinder", "ball", [3, 0, 0], 1)
        self.gap_is("cylinder", "box", [0, 0, 1.75], -0.25)
        self.gap_is("ellipsoid", "ball", [0, 0, 2.25], 0.25)
        self.gap_is("ellipsoid", "box", [0, 0, 1.5], -0.5, 1e-2)
        self.gap_is("padded", "ball", [4, 0, 0], 1.5)
        self.gap_is("padded", "box", [0, 0, 2.25], -0.25)
        self.gap_is("padded", "box", [0, 0, 1.75], -0.75)
        self.gap_is("padded", "padded", [4, 5, 0], math.sqrt(41) - 3)
        self.gap_is("floor", "padded cone", [0, 0, 1], 0.5)
        self.gap_is("padded ellipsoid", "ball", [0, 0, 2.25], -0.25)
        self.gap_is("triangle", "padded", [0, 0, 2], 0.5)
        self.gap_is("triangle", "box", [0, 0, 1.5], 0.5)
        self.gap_is("triangle", "box", [0, 0, 0.75], -0.25)

    def test_square_roots(self):
        for x in (F(1, 3) ** 700, F(2) ** -1500, F(10) ** 40 / 7):  # with as many digits, however small
            self.assertLessEqual(sqrt_lo(x) ** 2, x)
            self.assertLess(x, sqrt_hi(x) ** 2)
            self.assertLess(sqrt_hi(x) / sqrt_lo(x), 1 + F(1, 2**190))
        self.assertLess(sqrt_lo(F(2)) ** 2, 2)
        self.assertGreater(sqrt_hi(F(2)) ** 2, 2)
        self.assertLess(sqrt_hi(F(2)) - sqrt_lo(F(2)), F(1, 10 ** 50))

    def test_scale_counts_whole_lengths_and_the_separation(self):
        self.assertEqual(scale(scene("box", "ball", [0, 0, 0]), 0, 1), 2)
        self.assertAlmostEqual(float(scale(scene("box", "ball", [3, 4, 0]), 0, 1)), 5)

    def verdict(self, question, fault, s, answer):
        judge = Judge.__new__(Judge)
        judge.seconds, judge.cards = 20, {"mine": {"unit_roundoff": 2.0 ** -53, "tau_factor": 64, "source": "here"}}
        finding = {"engine": "mine", "question": question, "fault": fault, "observation": answer, "words": "", "blame": "algorithm"}
        with tempfile.TemporaryDirectory() as d:
            for name, content in (("finding", finding), ("case", {"scene": s, "queries": [{"question": question, "a": 0, "b": 1}]})):
                with open(os.path.join(d, name + ".json"), "w") as f:
                    json.dump(content, f)
            return judge.accusation(d)[0]

    def test_accusations(self):
        boxes, apart = scene("box", "box", [1.5, 0, 0]), scene("box", "box", [2.5, 0, 0])
        right = {"overlap": True, "normal": [1, 0, 0], "depth": 0.5, "manifold": [{"position": [0.75, 0, 0], "depth": 0.5}]}
        for fault in ("infeasible", "not_minimal", "depth_excess", "point_off", "normal_not_unit", "ghost"):
            self.assertEqual(self.verdict("contact", fault, boxes, right), "refuted", fault)
        wrong = {"infeasible": {"depth": 0.4}, "not_minimal": {"normal": [0, 1, 0], "depth": 2}, "depth_excess": {"depth": 0.6},
                 "point_off": {"manifold": [{"position": [3.5, 0, 0]}]}, "normal_not_unit": {"normal": [0, 0, 0]},
                 "missed": {"overlap": False}}
        for fault, change in wrong.items():
            self.assertEqual(self.verdict("contact", fault, boxes, {**right, **change}), "confirmed", fault)
        self.assertEqual(self.verdict("overlap", "ghost", apart, {"overlap": True}), "confirmed")
        self.assertEqual(self.verdict("distance", "distance_off", apart, {"distance": 0.5}), "refuted")
        self.assertEqual(self.verdict("distance", "distance_off", apart, {"distance": 0.51}), "confirmed")
        self.assertEqual(self.verdict("distance", "distance_off", apart, {"distance": 0.51, "claimed_tolerance": 0.02}), "refuted")
        witness = {"distance": 0.5, "witness": [[1, 0, 0], [1.5, 0.25, 0]]}
        self.assertEqual(self.verdict("distance", "witness_off", apart, witness), "confirmed")

    def test_contacts_within_a_margin(self):
        apart = {**scene("box", "box", [2.5, 0, 0]), "margin": 0.75}
        right = {"overlap": True, "normal": [1, 0, 0], "depth": -0.5, "manifold": [{"position": [1.25, 0, 0], "depth": -0.5}]}
        for fault in ("infeasible", "not_minimal", "depth_excess", "point_off", "ghost"):
            self.assertEqual(self.verdict("contact_within", fault, apart, right), "refuted", fault)
        wrong = {"infeasible": {"depth": -0.6}, "not_minimal": {"normal": [-1, 0, 0]}, "depth_excess": {"depth": 0},
                 "point_off": {"manifold": [{"position": [2, 0, 0], "depth": -0.5}]}, "missed": {"overlap": False}}
        for fault, change in wrong.items():
            self.assertEqual(self.verdict("contact_within", fault, apart, {**right, **change}), "confirmed", fault)
        self.assertEqual(self.verdict("contact_within", "ghost", {**apart, "margin": 0.25}, right), "confirmed")

    def test_impacts(self):
        ahead = scene("box", "box", [4, 0, 0], {"linear": [-4, 0, 0]})
        for toi, fault, expected in ((0.5, "early", "refuted"), (0.4, "early", "confirmed"), (0.6, "late", "confirmed"), (None, "missed", "confirmed")):
            self.assertEqual(self.verdict("time_of_impact", fault, ahead, {"toi": toi} if toi else {}), expected)
        turning = scene("box", "box", [2.25, 0, 0], {"angular": [0, 0, 0.7853981633974483]})
        self.assertEqual(self.verdict("time_of_impact", "missed", turning, {}), "confirmed")


if __name__ == "__main__":
    unittest.main()
