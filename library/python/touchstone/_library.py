"""The C interface touchstone.h by ctypes and NumPy."""
from __future__ import annotations

import ctypes as c
import os
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Optional, Sequence

import numpy as np

VERSION = "0"  # of the binary interface: the soname


def _load() -> c.CDLL:
    name = f"libtouchstone.so.{VERSION}"
    given = os.environ.get("TOUCHSTONE_LIBRARY")
    beside = Path(__file__).parent / name
    return c.CDLL(given or (str(beside) if beside.exists() else name))


_library = _load()
_library.touchstone_version.restype = c.c_char_p
_library.touchstone_last_error.restype = c.c_char_p
_library.touchstone_free_shape.argtypes = [c.c_void_p]
_library.touchstone_free_text.argtypes = [c.c_void_p]

GAP = np.dtype([("lo", "f8"), ("hi", "f8"), ("normal", "f8", 3), ("witness_a", "f8", 3), ("witness_b", "f8", 3),
                ("verdict", "i4"), ("within_margin", "i4")], align=True)
IMPACT = np.dtype([("t_lo", "f8"), ("t_hi", "f8"), ("gap_lo", "f8"), ("gap_hi", "f8"), ("verdict", "i4")], align=True)
STATED = np.dtype([("distance", "f8"), ("depth", "f8"), ("time_of_impact", "f8"), ("normal", "f8", 3),
                   ("witness_a", "f8", 3), ("witness_b", "f8", 3), ("stated", "i4"), ("overlap", "i4")], align=True)
CLAIMS = {"overlap": 1, "distance": 2, "normal": 4, "depth": 8, "witness": 16, "impact": 32}


class Error(ValueError):
    """An argument is not valid, or the library failed."""


def _require(status: int) -> None:
    if status:
        raise Error(_library.touchstone_last_error().decode())


def version() -> str:
    """Of the library."""
    return _library.touchstone_version().decode()


def _pointer(array: Optional[np.ndarray]) -> Optional[c.c_void_p]:
    return None if array is None else c.c_void_p(array.ctypes.data)


class Shape:
    """An immutable shape, from text or from the JSON of the scene format. Raises Error."""

    def __init__(self, text: str):
        self._handle = c.c_void_p()
        _require(_library.touchstone_parse_shape(text.encode(), c.byref(self._handle)))

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            _library.touchstone_free_shape(self._handle)


def parse_body(text: str) -> tuple[Shape, np.ndarray, Optional[np.ndarray]]:
    """Shape, pose and motion (None at rest) of "box 1 1 1 at 0 0 2 move 0 0 1"."""
    shape, pose, motion = Shape.__new__(Shape), np.zeros(7), np.zeros(6)
    shape._handle = c.c_void_p()
    _require(_library.touchstone_parse_body(text.encode(), c.byref(shape._handle), _pointer(pose), _pointer(motion)))
    return shape, pose, motion if motion.any() else None


def _points(points: Any) -> np.ndarray:
    array = np.ascontiguousarray(points, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 3:
        raise Error("points: must be n rows of 3 numbers")
    return array


def hull(points: Any) -> Shape:
    """The convex hull of n x 3 points."""
    shape, array = Shape.__new__(Shape), _points(points)
    shape._handle = c.c_void_p()
    _require(_library.touchstone_hull(_pointer(array), c.c_size_t(len(array)), c.byref(shape._handle)))
    return shape


def mesh(points: Any, triangles: Any) -> Shape:
    """The surface of m x 3 indices into n x 3 points."""
    shape, array = Shape.__new__(Shape), _points(points)
    faces = np.asarray(triangles)
    if faces.ndim != 2 or faces.shape[1] != 3 or faces.dtype.kind not in "iu":
        raise Error("triangles: must be m rows of 3 indices")
    faces = np.ascontiguousarray(faces, dtype=np.int32)
    shape._handle = c.c_void_p()
    _require(_library.touchstone_mesh(_pointer(array), c.c_size_t(len(array)), _pointer(faces),
                                      c.c_size_t(len(faces)), c.byref(shape._handle)))
    return shape


def rows(x: Any, columns: int, name: str) -> Optional[np.ndarray]:
    if x is None:
        return None
    array = np.ascontiguousarray(x, dtype=np.float64)
    if array.ndim not in (1, 2) or array.shape[-1] != columns:
        raise Error(f"{name}: must be {columns} numbers, or rows of {columns}")
    return array


def _repeated(x: Optional[np.ndarray], n: int) -> Optional[np.ndarray]:
    if x is None or x.ndim == 2:
        return x
    return np.ascontiguousarray(np.broadcast_to(x, (n, len(x))))


def batch(a: Any, b: Any) -> tuple[Any, ...]:
    """(shape, poses, motions) of A and of B, and n."""
    arrays = [a.pose, a.motion, b.pose, b.motion]
    counts = {len(x) for x in arrays if x is not None and x.ndim == 2}
    if len(counts) > 1:
        raise Error(f"batches of different lengths: {sorted(counts)}")
    n = counts.pop() if counts else 1
    return (a.shape, _repeated(a.pose, n), _repeated(a.motion, n), b.shape, _repeated(b.pose, n),
            _repeated(b.motion, n), n)


def first(batch_of: Any) -> SimpleNamespace:
    values = {name: getattr(batch_of, name)[0] for name in batch_of.__dataclass_fields__}
    return SimpleNamespace(**{k: v.item() if np.ndim(v) == 0 else v for k, v in values.items()})


def gaps(a: Shape, poses_a: Any, motions_a: Any, b: Shape, poses_b: Any, motions_b: Any, n: int,
         margin: float) -> np.ndarray:
    if motions_a is not None or motions_b is not None:
        raise Error("a gap is of bodies at rest; ask for impacts")
    out = np.zeros(n, GAP)
    _require(_library.touchstone_gaps(a._handle, _pointer(poses_a), b._handle, _pointer(poses_b), c.c_size_t(n),
                                      c.c_double(margin), _pointer(out)))
    return out


def _sides(a: Any, poses_a: Any, motions_a: Any, b: Any, poses_b: Any, motions_b: Any) -> list[Any]:
    return [a._handle, _pointer(poses_a), _pointer(motions_a), b._handle, _pointer(poses_b), _pointer(motions_b)]


def impacts(*args: Any) -> np.ndarray:
    out = np.zeros(args[-1], IMPACT)
    _require(_library.touchstone_impacts(*_sides(*args[:6]), c.c_size_t(args[-1]), _pointer(out)))
    return out


def _one(a: Any, b: Any) -> list[Any]:
    arrays = batch(a, b)
    if a.count is not None or b.count is not None:
        raise Error("is about one pair, not a batch")
    return _sides(*arrays[:6])


def normals(a: Any, b: Any) -> tuple[np.ndarray, bool]:
    side = _one(a, b)
    found, complete, out = c.c_size_t(), c.c_int(), np.zeros((256, 3))
    _require(_library.touchstone_normals(side[0], side[1], side[3], side[4], _pointer(out), c.c_size_t(len(out)),
                                         c.byref(found), c.byref(complete)))
    return out[:found.value].copy(), bool(complete.value)


def _text(pointer: c.c_void_p) -> str:
    try:
        return c.string_at(pointer).decode()
    finally:
        _library.touchstone_free_text(pointer)


def answer(a: Any, b: Any) -> str:
    out = c.c_void_p()
    _require(_library.touchstone_answer(*_one(a, b), c.byref(out)))
    return _text(out)


def check(a: Any, b: Any, certificate: str) -> bool:
    valid = c.c_int()
    _require(_library.touchstone_check(*_one(a, b), certificate.encode(), c.byref(valid)))
    return bool(valid.value)


def stated(n: int, claims: dict[str, Any]) -> np.ndarray:
    """n rows of touchstone_stated."""
    out = np.zeros(n, STATED)
    for name, value in claims.items():
        if name not in CLAIMS:
            raise Error(f"unknown claim {name}; known are {', '.join(CLAIMS)}")
        out["stated"] |= CLAIMS[name]
        shape = {"normal": (n, 3), "witness": (n, 2, 3)}.get(name, (n,))
        value = np.nan if name == "impact" and value is None else value
        try:
            array = np.broadcast_to(np.asarray(value, dtype=np.float64), shape)
        except ValueError as e:
            raise Error(f"{name}: {e}") from None
        if name == "witness":
            out["witness_a"], out["witness_b"] = array[:, 0], array[:, 1]
        else:
            out["time_of_impact" if name == "impact" else name] = array
    return out


def judge(*args: Any) -> np.ndarray:
    n, says, tolerance, single = args[6:]
    out = np.zeros(n, np.int32)
    _require(_library.touchstone_judge(*_sides(*args[:6]), c.c_size_t(n), _pointer(says), c.c_double(tolerance),
                                       c.c_int(single), _pointer(out)))
    return out


def explain(a: Any, b: Any, says: np.ndarray, tolerance: float, single: bool) -> str:
    out = c.c_void_p()
    _require(_library.touchstone_explain(*_one(a, b), _pointer(says), c.c_double(tolerance), c.c_int(single),
                                         c.byref(out)))
    return _text(out)
