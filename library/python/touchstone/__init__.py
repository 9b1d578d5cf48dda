"""Touchstone's referee: certified distances, contacts and times of impact of pairs of bodies, and a judge of other
engines' answers.

A body is text ("box 1 1 1": half extents; "cylinder 0.5 2 at 0 0 1.2": radius and half height; `touchstone answer
--help` lists all), the JSON of the scene format, or the result of `body` with a shape of those forms, of `hull` or of
`mesh`. A pose is 7 numbers: position x y z and
quaternion x y z w; a motion is 6: linear and angular velocity over one step. Arrays of n rows are batches. Overlap
includes touching; the signed gap of an overlap is minus its depth; normals point from A to B.
"""
from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _library as _c
from ._library import Error, Shape, hull, mesh, version

__all__ = ["Body", "Error", "Gaps", "Impacts", "Rulings", "Shape", "answer", "body", "check", "explain", "gap", "gaps",
           "hull", "impact", "impacts", "judge", "mesh", "normals", "version"]

DISJOINT, OVERLAP, UNDECIDED = 0, 1, 2
NO_IMPACT, IMPACT = 0, 1
RIGHT, WRONG, OPEN, NOT_JUDGED = 0, 1, 2, 3

ShapeLike = Union[str, Shape]


@dataclass(frozen=True)
class Body:
    """A shape with one pose or n of them, and as many motions."""
    shape: Shape
    pose: Optional[NDArray[np.float64]] = None
    motion: Optional[NDArray[np.float64]] = None

    @property
    def count(self) -> Optional[int]:
        """The number of rows; None for a single body."""
        rows = [len(x) for x in (self.pose, self.motion) if x is not None and x.ndim == 2]
        return rows[0] if rows else None


def body(shape: ShapeLike, pose: Optional[ArrayLike] = None, motion: Optional[ArrayLike] = None) -> Body:
    """A body, or a batch when pose or motion has n rows. Raises Error for a wrong number of columns."""
    return Body(shape if isinstance(shape, Shape) else Shape(shape), _c.rows(pose, 7, "pose"),
                _c.rows(motion, 6, "motion"))


def _body(x: Union[Body, ShapeLike]) -> Body:
    if isinstance(x, Body):
        return x
    return Body(x) if isinstance(x, Shape) else Body(*_c.parse_body(x))


@dataclass(frozen=True)
class Gaps:
    """Brackets lo <= signed gap <= hi with normals and witness points, one row a pair."""
    lo: NDArray[np.float64]
    hi: NDArray[np.float64]
    normal: NDArray[np.float64]
    witness_a: NDArray[np.float64]
    witness_b: NDArray[np.float64]
    verdict: NDArray[np.int32]  # DISJOINT, OVERLAP, UNDECIDED
    within_margin: NDArray[np.int32]  # 1 yes, 0 no, -1 undecided


@dataclass(frozen=True)
class Impacts:
    """First contacts: none before t_lo, one at t_hi at the latest; and the least gap of the step."""
    t_lo: NDArray[np.float64]
    t_hi: NDArray[np.float64]
    gap_lo: NDArray[np.float64]
    gap_hi: NDArray[np.float64]
    verdict: NDArray[np.int32]  # NO_IMPACT, IMPACT, UNDECIDED


class Rulings(np.ndarray):
    """RIGHT, WRONG, OPEN or NOT_JUDGED for each answer."""


def gaps(a: Union[Body, ShapeLike], b: Union[Body, ShapeLike], margin: float = 0) -> Gaps:
    """Signed gaps of all pairs of a batch. `margin`: see Gaps.within_margin."""
    found = _c.gaps(*_c.batch(_body(a), _body(b)), margin)
    return Gaps(**{name: found[name] for name in Gaps.__dataclass_fields__})


def gap(a: Union[Body, ShapeLike], b: Union[Body, ShapeLike], margin: float = 0) -> Any:
    """The signed gap of one pair: the fields of Gaps as numbers and vectors of 3."""
    return _c.first(gaps(a, b, margin))


def impacts(a: Union[Body, ShapeLike], b: Union[Body, ShapeLike]) -> Impacts:
    """First contacts of all pairs of a batch over the step t in [0, 1]."""
    found = _c.impacts(*_c.batch(_body(a), _body(b)))
    return Impacts(**{name: found[name] for name in Impacts.__dataclass_fields__})


def impact(a: Union[Body, ShapeLike], b: Union[Body, ShapeLike]) -> Any:
    """The first contact of one pair."""
    return _c.first(impacts(a, b))


def normals(a: Union[Body, ShapeLike], b: Union[Body, ShapeLike]) -> tuple[NDArray[np.float64], bool]:
    """The directions of least depth of one overlapping pair (k x 3), and whether these are all."""
    return _c.normals(_body(a), _body(b))


def answer(a: Union[Body, ShapeLike], b: Union[Body, ShapeLike]) -> dict[str, Any]:
    """Everything about one pair with certificates, as `touchstone answer --json` prints it."""
    return json.loads(_c.answer(_body(a), _body(b)))


def check(a: Union[Body, ShapeLike], b: Union[Body, ShapeLike], certificate: dict[str, Any]) -> bool:
    """Whether a certificate of such an answer proves its claim, in exact arithmetic."""
    return _c.check(_body(a), _body(b), json.dumps(certificate))


def judge(a: Union[Body, ShapeLike], b: Union[Body, ShapeLike], *, tolerance: float = 0, single: bool = False,
          **stated: Any) -> Any:
    """Rules on what an engine says: any of overlap, distance (signed), normal (A to B), depth, witness (two points),
    impact (NaN or None: none). Numbers for one pair, arrays of n rows for a batch. Returns RIGHT, WRONG, OPEN or
    NOT_JUDGED, or Rulings for a batch. `tolerance` is allowed besides rounding; `single`: computed in floats."""
    a, b = _body(a), _body(b)
    shapes = _c.batch(a, b)
    found = _c.judge(*shapes, _c.stated(shapes[-1], stated), tolerance, single)
    return int(found[0]) if a.count is None and b.count is None else found.view(Rulings)


def explain(a: Union[Body, ShapeLike], b: Union[Body, ShapeLike], *, tolerance: float = 0, single: bool = False,
            **stated: Any) -> dict[str, Any]:
    """The ruling on one answer with the reasons; arguments as for `judge`."""
    return json.loads(_c.explain(_body(a), _body(b), _c.stated(1, stated), tolerance, single))
