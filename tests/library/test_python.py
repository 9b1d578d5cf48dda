"""The Python interface. Run by ctest with pytest; TOUCHSTONE_LIBRARY names the library."""
import json
import math
import subprocess
import sys

import numpy as np
import pytest

import touchstone

BALL = "sphere 0.5 at 0 0 1.75"


def test_gap_of_one_pair():
    g = touchstone.gap("box 1 1 1", BALL)
    assert g.lo <= 0.25 <= g.hi and g.hi - g.lo < 1e-12
    assert g.verdict == touchstone.DISJOINT
    assert np.allclose(g.normal, (0, 0, 1)) and np.allclose(g.witness_a, (0, 0, 1))
    assert touchstone.gap("box 1 1 1", BALL, margin=0.3).within_margin == 1
    assert touchstone.gap("box 1 1 1", BALL, margin=0.2).within_margin == 0


def test_batches_equal_single_answers():
    rng = np.random.default_rng(3)
    poses = np.hstack([rng.normal(size=(50, 3)) * 2, rng.normal(size=(50, 4))])
    many = touchstone.gaps("capsule 0.3 1", touchstone.body("box 1 0.5 2", poses))
    assert many.lo.shape == (50,) and many.normal.shape == (50, 3)
    assert {0, 1} == set(many.verdict)
    for i in range(50):
        one = touchstone.gap("capsule 0.3 1", touchstone.body("box 1 0.5 2", poses[i]))
        assert (one.lo, one.hi, one.verdict) == (many.lo[i], many.hi[i], many.verdict[i])
        assert (one.normal == many.normal[i]).all()


def test_hull_and_mesh():
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    h = touchstone.gap(touchstone.hull(points), "sphere 1 at 3 0 0")
    assert h.lo <= 1 <= h.hi
    m = touchstone.gap(touchstone.mesh(points, [[0, 1, 2]]), "sphere 1 at 0.2 0.2 -3")
    assert m.lo <= 2 <= m.hi


def test_normals_of_a_cube_in_a_cube():
    found, complete = touchstone.normals("box 1 1 1", "box 0.5 0.5 0.5")
    assert complete and len(found) == 6
    assert {tuple(n) for n in np.abs(found).astype(int)} == {(1, 0, 0), (0, 1, 0), (0, 0, 1)}


def test_impacts():
    falling = touchstone.body("sphere 0.5", [0, 0, 1.75, 0, 0, 0, 1], [[0, 0, -1, 0, 0, 0], [0, 0, 1, 0, 0, 0]])
    t = touchstone.impacts("box 1 1 1", falling)
    assert list(t.verdict) == [touchstone.IMPACT, touchstone.NO_IMPACT]
    assert t.t_lo[0] <= 0.25 <= t.t_hi[0]


def test_answer_and_check():
    a, b = "box 1 1 1", BALL
    found = touchstone.answer(a, b)
    assert found["certified"] is True
    for certificate in found["certificates"].values():
        assert touchstone.check(a, b, certificate)
    damaged = dict(found["certificates"]["at_least"], offset=-0.26)
    assert not touchstone.check(a, b, damaged)
    with pytest.raises(touchstone.Error, match="kind"):
        touchstone.check(a, b, {"kind": "nonsense"})


def test_judge():
    a, b = "box 1 1 1", BALL
    assert touchstone.judge(a, b, distance=0.25, normal=(0, 0, 1)) == touchstone.RIGHT
    assert touchstone.judge(a, b, distance=0.0, normal=(0, 0, 1)) == touchstone.WRONG
    assert touchstone.judge(a, b, distance=0.25, normal=(0, 1, 0)) == touchstone.WRONG
    assert touchstone.judge(a, b, overlap=True) == touchstone.WRONG
    assert touchstone.judge(a, b, distance=0.2500001) == touchstone.WRONG
    assert touchstone.judge(a, b, distance=0.2500001, tolerance=1e-6) == touchstone.RIGHT
    assert touchstone.judge(a, b, distance=0.2500001, single=True) == touchstone.RIGHT
    assert touchstone.judge(a, b, distance=math.nan) == touchstone.WRONG
    assert touchstone.judge(a, b, witness=[(0, 0, 1), (0, 0, 1.25)]) == touchstone.RIGHT
    falling = BALL + " move 0 0 -1"
    assert touchstone.judge(a, falling, impact=0.25) == touchstone.RIGHT
    assert touchstone.judge(a, falling, impact=None) == touchstone.WRONG
    why = touchstone.explain(a, b, distance=0.0)
    assert why["ruling"] == "wrong" and "says 0" in why["faults"][0]["words"]


def test_judge_of_a_batch():
    z = np.linspace(1.6, 2.6, 11)
    poses = np.zeros((11, 7))
    poses[:, 2], poses[:, 6] = z, 1
    says = z - 1.5
    says[4] += 1e-3
    rulings = touchstone.judge("box 1 1 1", touchstone.body("sphere 0.5", poses), distance=says, normal=(0, 0, 1))
    assert [i for i, r in enumerate(rulings) if r != touchstone.RIGHT] == [4]
    assert rulings[4] == touchstone.WRONG


@pytest.mark.parametrize("bad", ["", "bax 1 1 1", "box 1 1", "box 1 1 1 1", "box -1 1 1", "box 1 1 nan", "sphere 1 at 0",
                                 "sphere 1 rot 0 0 1 30", "{", '{"shape": 1}', "mesh 1 2 3"])
def test_bad_bodies_are_refused(bad):
    with pytest.raises(touchstone.Error):
        touchstone.gap(bad, "sphere 1")


def test_bad_arguments_are_refused():
    with pytest.raises(touchstone.Error, match="pose"):
        touchstone.body("sphere 1", [0, 0, 1])
    with pytest.raises(touchstone.Error, match="quaternion"):
        touchstone.gap("sphere 1", touchstone.body("sphere 1", [0, 0, 3, 0, 0, 0, 0]))
    with pytest.raises(touchstone.Error, match="not finite"):
        touchstone.gap("sphere 1", touchstone.body("sphere 1", [0, 0, math.inf, 0, 0, 0, 1]))
    with pytest.raises(touchstone.Error, match="different lengths"):
        touchstone.gaps(touchstone.body("sphere 1", np.ones((2, 7))), touchstone.body("sphere 1", np.ones((3, 7))))
    with pytest.raises(touchstone.Error, match="unknown claim"):
        touchstone.judge("sphere 1", "sphere 1", distanze=1)
    with pytest.raises(touchstone.Error):
        touchstone.judge("sphere 1", "sphere 1")
    with pytest.raises(touchstone.Error, match="normal"):
        touchstone.judge("sphere 1", "sphere 1", normal=(0, 1))
    with pytest.raises(touchstone.Error, match="margin"):
        touchstone.gap("sphere 1", "sphere 1", margin=-1)


def test_the_module_runs():
    def run(*arguments):
        return subprocess.run([sys.executable, "-m", "touchstone", *arguments], capture_output=True, text=True)

    good = run("box 1 1 1", BALL)
    assert good.returncode == 0 and json.loads(good.stdout)["verdict"] == "disjoint"
    bad = run("box 1 1", BALL)
    assert bad.returncode == 2 and "first" not in bad.stdout and "number is missing" in bad.stderr
    assert run("box 1 1 1").returncode == 2
