"""Volumes of surfaces and of their bubbles, whose openings are closed by fans."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pxr import Usd, UsdGeom

from balloon_usd.diff.surface import Surface, surface_of

CUBE = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=np.float64)
FACES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def cube(faces: list[list[int]] = FACES, **subsets: list[int]) -> Usd.Prim:
    stage = Usd.Stage.CreateInMemory()
    mesh = UsdGeom.Mesh.Define(stage, "/cube")
    mesh.CreatePointsAttr(CUBE.astype(np.float32))
    mesh.CreateFaceVertexCountsAttr([len(face) for face in faces])
    mesh.CreateFaceVertexIndicesAttr([corner for face in faces for corner in face])
    for name, rows in subsets.items():
        family = "bubbles" if name.startswith("bubble") else "other"
        UsdGeom.Subset.CreateGeomSubset(mesh, name, UsdGeom.Tokens.face, rows, family)
    # A prim is gone with its stage.
    prim = mesh.GetPrim()
    KEPT.append(stage)
    return prim


KEPT: list[Usd.Stage] = []


def found(prim: Usd.Prim) -> Surface:
    surface = surface_of(prim, Usd.TimeCode.EarliestTime())
    assert surface is not None
    return surface


def test_a_cube_holds_its_volume() -> None:
    assert found(cube()).volumes(CUBE) == {"": pytest.approx(1.0)}


def test_faces_turned_inside_out_hold_the_same() -> None:
    assert found(cube([face[::-1] for face in FACES])).volumes(CUBE) == {"": pytest.approx(1.0)}


def test_an_opening_is_closed() -> None:
    assert found(cube(FACES[:5])).volumes(CUBE) == {"": pytest.approx(1.0)}
    assert found(cube(FACES[:4])).volumes(CUBE) == {"": pytest.approx(1.0)}


def test_a_flat_part_holds_none() -> None:
    assert found(cube(bubble_one=[0], bubble_rest=[1, 2, 3, 4, 5])).volumes(CUBE).keys() == {
        "",
        "bubble_rest",
    }


def test_bubbles_go_before_other_subsets() -> None:
    assert [part.name for part in found(cube(side=[0], bubble_one=[1])).parts] == ["", "bubble_one"]
    assert [part.name for part in found(cube(side=[0])).parts] == ["", "side"]


@given(
    shift=st.tuples(*[st.floats(-100, 100)] * 3),
    size=st.floats(1e-3, 1e3),
    faces=st.sets(st.integers(0, 5), min_size=1, max_size=6),
)
def test_volume_depends_on_no_place_and_grows_with_the_cube_of_the_size(
    shift: tuple[float, float, float], size: float, faces: set[int]
) -> None:
    surface = found(cube(bubble=sorted(faces)))
    here, there = surface.volumes(CUBE), surface.volumes(size * CUBE + shift)
    assert here.keys() == there.keys()
    for name, volume in here.items():
        assert there[name] == pytest.approx(volume * size**3, rel=1e-5)


@pytest.mark.parametrize("faces", [[], [[0, 1, 8]], [[0, 1, -1]]])
def test_faces_that_are_not_right_are_no_surface(faces: list[list[int]]) -> None:
    assert surface_of(cube(faces), Usd.TimeCode.EarliestTime()) is None
