"""The print on the rubber, which shows how a balloon turns."""

import numpy as np
import pytest

from balloon_usd.balloon.detail import detail_named
from balloon_usd.openusd import Usd, UsdGeom
from balloon_usd.plan import plan
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.recipe import Recipe
from balloon_usd.stage import write_stage
from balloon_usd.stage.printed import INK, printed
from tests.stage.conftest import frames, sculpture

TUBE = """
format: 1
name: tube
units: cm
balloons: {main: {size: 260, tail: 10}}
steps:
  - bubbles: {nose: 10}
"""


@pytest.mark.parametrize("detail", ["draft", "preview", "full"])
def test_two_rows_of_dashes_lie_opposite_each_other_on_a_tube(detail):
    (strip,) = plan(Recipe.parse(TUBE)).strips.values()
    mesh = mesh_of(strip, detail_named(detail))
    around = mesh.st[:, :, 0].mean(axis=1)
    inked = printed(mesh.st)
    assert 0.03 < inked.mean() < 0.2
    rows = np.unique(np.round(around[inked], 3))
    assert np.diff(np.sort(np.concatenate([rows, rows[rows < 0.5] + 1.0]))).max() == pytest.approx(
        0.5, abs=0.09
    )


def test_print_on_a_tube_reads_the_same_in_a_mirror():
    (strip,) = plan(Recipe.parse(TUBE)).strips.values()
    mesh = mesh_of(strip, detail_named("draft"))
    for each in (mesh, mesh.mirrored()):
        corners, st = each.points[each.quads], each.st
        a, b = corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0]
        s, t = st[:, 1] - st[:, 0], st[:, 3] - st[:, 0]
        outward = np.cross(a, b)
        tube = np.abs(outward[:, 0]) < 0.1 * np.linalg.norm(outward, axis=1)
        assert (outward[tube, 1:] * corners[tube, :, 1:].mean(axis=1)).sum(axis=1).min() > 0.0
        assert (np.sign(s[tube, 0] * t[tube, 1] - s[tube, 1] * t[tube, 0]) == 1.0).all()


@pytest.mark.parametrize("form", [{}, {"flat": True}, {"usdz": True}])
def test_the_look_print_has_a_colour_for_every_quad(form, tmp_path):
    described = sculpture()
    written = write_stage(described, frames(3), tmp_path, look="print", **form)
    stage = Usd.Stage.Open(str(written.files[0]))
    meshes = [UsdGeom.Mesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
    for mesh, told in zip(meshes, described.meshes, strict=True):
        primvar = mesh.GetDisplayColorPrimvar()
        assert primvar.GetInterpolation() == UsdGeom.Tokens.uniform
        colors = np.array(primvar.Get())
        assert len(colors) == len(told.quads)
        assert (colors == np.where(printed(told.st)[:, None], np.float32(INK), np.float32(told.color))).all()
