"""Blender's import of our stages: every frame bit for bit, in every selection of variants."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom, UsdShade, Vt

from balloon_usd import RecipeBuilder, plan_recipe, simulate, write_stage
from balloon_usd.stage import write_stage as write_described
from tests.blender.selections import all_selections
from tests.stage.capsule import Capsule
from tests.stage.tubes import frames, sculpture

if TYPE_CHECKING:
    from collections.abc import Callable

ROOT = Path(__file__).parents[2]
GOLDEN = ROOT / "stages"


STAGES = {
    "two balloons": {"detail": "full"},
    "two balloons, flat": {"flat": True},
    "two balloons, flat, stress": {"flat": True, "look": "stress"},
    "two balloons, usdz": {"usdz": True},
    "two balloons, usdz, clear": {"usdz": True, "look": "clear"},
    "air": {"detail": "full"},
    "air, flat": {"flat": True},
    "air, usdz": {"usdz": True},
}
"""How each stage is written; of a layered one this is the first of two details."""


@pytest.fixture(scope="session")
def written(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """A stage of two balloons or of one with air in it, once a session. Only to be read."""

    @cache
    def write(name: str) -> Path:
        folder, options = tmp_path_factory.mktemp("written"), STAGES[name]
        coarse, fine = Capsule(), Capsule(n=3, along=6, grid=(8, 3, 3))
        air = name.startswith("air")
        if "detail" in options:
            rings = (sculpture(rings=9), frames(8, rings=9))
            write_described(*((fine.describe(), fine.frames(8)) if air else rings), folder, **options)
            options = {"shot": True}
        given = (coarse.describe(), coarse.frames(8)) if air else (sculpture(fps=12.5), frames(8))
        return write_described(*given, folder, **options).files[0]

    return write


@pytest.mark.parametrize("name", ["pair", "caterpillar"])
def test_a_golden_stage_arrives_bit_for_bit(blender, name):
    done = blender("compare:compare_stage", GOLDEN / name / f"{name}.usda")
    assert done.findings == ()
    assert done.frames > 30


@pytest.mark.parametrize("name", STAGES)
def test_a_stage_arrives_bit_for_bit_in_every_selection(blender, written, name):
    done = blender("compare:compare_stage", written(name))
    assert done.findings == ()
    assert done.selections == len(all_selections(written(name)))


@pytest.mark.parametrize("name", ["two balloons", "air"])
def test_a_shot_arrives_with_camera_lights_and_ground(blender, written, name):
    file = written(name)
    done = blender("compare:compare_stage", file.parents[1] / f"{file.stem}_shot.usda")
    assert done.findings == ()


def test_the_selections_are_those_of_detail_state_and_look(written):
    chosen = all_selections(written("air"))
    looks = {"recipe", "clear", "chrome", "clay", "print", "stress", "thesis"}
    assert {one["detail"] for one in chosen} == {"draft", "full"}
    assert {one["state"] for one in chosen} == {"made", "finished"}
    assert {one["look"] for one in chosen} == looks
    assert len(chosen) == 2 * 2 * len(looks)


def test_blender_shows_the_points_that_the_simulator_gave(blender, tmp_path):
    recipe = (
        RecipeBuilder("bud")
        .balloon("main", size=260, color="green", length=0.06, tail=0.02)
        .bubbles(head=0.05)
        .rest("stem")
        .build()
    )
    plan = plan_recipe(recipe)
    given = [
        replace(frame, points=tuple(p.copy() for p in frame.points)) for frame in simulate(plan, device="cpu")
    ]
    file = write_stage(plan, given, tmp_path).files[0]
    dumped = {"main": np.stack([frame.points[0] for frame in given])}
    done = blender("compare:compare_stage", file, frames=dumped)
    assert done.findings == ()
    assert done.frames == len(given)

    dumped["main"][-1, 7, 2] = np.nextafter(dumped["main"][-1, 7, 2], np.float32(1))
    [finding] = blender("compare:compare_stage", file, frames=dumped).findings
    assert f"/bud/geo/render/main.points: at {len(given)}: element 7" in finding


MESH = "/dog/geo/render/main"


def one_bit_of_a_point(stage):
    _nudge(stage.GetAttributeAtPath(f"{MESH}.points"), 5)


def one_bit_of_a_stretch(stage):
    _nudge(stage.GetAttributeAtPath(f"{MESH}.primvars:stretch"), 5)


def a_bubble_of_a_face(stage):
    bubble = stage.GetAttributeAtPath(f"{MESH}.primvars:bubble")
    bubble.Set(Vt.IntArray([1, *list(bubble.Get())[1:]]))


def a_subset(stage):
    stage.GetAttributeAtPath(f"{MESH}/nose.indices").Set(Vt.IntArray([0]))


def a_texture_coordinate(stage):
    st = stage.GetAttributeAtPath(f"{MESH}.primvars:st")
    st.Set(Vt.Vec2fArray([(0.5, 0.5), *list(st.Get())[1:]]))


def a_colour(stage):
    look = UsdShade.Shader(stage.GetPrimAtPath("/dog/mtl/latex_main/preview"))
    look.GetInput("diffuseColor").Set((0.1, 0.2, 0.3))


def an_end(stage):
    stage.GetRootLayer().endTimeCode = 9


def what_a_colour_reads(stage):
    stress = Usd.PrimRange(stage.GetPrimAtPath("/dog/mtl/stress"))
    reader = next(prim for prim in stress if prim.GetAttribute("inputs:varname"))
    reader.GetAttribute("inputs:varname").Set("stretch")


def a_place(stage):
    UsdGeom.XformCommonAPI(stage.GetDefaultPrim()).SetTranslate((0.0, 0.0, 0.001))


def another_unit(stage):
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)


def another_up_axis(stage):
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)


def a_face(stage):
    corners = stage.GetAttributeAtPath(f"{MESH}.faceVertexIndices")
    first, second, *others = corners.Get()
    corners.Set(Vt.IntArray([second, first, *others]))


def a_thing_more(stage):
    UsdGeom.Xform.Define(stage, "/dog/geo/render/lead")


def _nudge(attribute, time):
    values = np.array(attribute.Get(time))
    values.flat[4] = np.nextafter(values.flat[4], np.float32(np.inf))
    attribute.Set(values, time)


ON_FLAT = [
    (one_bit_of_a_point, f"{MESH}.points: at 5: element 1 is"),
    (one_bit_of_a_stretch, f"{MESH}.stretch: at 5: element 4 is"),
    (a_bubble_of_a_face, f"{MESH}.bubble: at 1: element 0 is [1], in Blender [0]"),
    (a_subset, f"{MESH}: faces of nose differ"),
    (a_texture_coordinate, f"{MESH}.st: at 1: element 0 is"),
    (a_colour, f"{MESH}: /dog/mtl/latex_main: diffuseColor is"),
    (an_end, "time codes (1.0, 9.0), in Blender (1, 8)"),
    (a_place, f"{MESH}.place: at 1: 0.001 m off"),
    (another_unit, f"{MESH}.place: at 1:"),
    (another_up_axis, f"{MESH}.place: at 1:"),
    (a_face, f"{MESH}: faces differ"),
    (a_thing_more, "/dog/geo/render/lead: does not arrive"),
]


@pytest.mark.parametrize(("change", "told"), ON_FLAT)
def test_what_differs_is_found(blender, written, tmp_path, change, told):
    assert told in findings_after(blender, written("two balloons, flat"), change, tmp_path)


def test_a_colour_that_comes_from_elsewhere_is_found(blender, written, tmp_path):
    found = findings_after(blender, written("two balloons, flat, stress"), what_a_colour_reads, tmp_path)
    assert "diffuseColor reads stretch, in Blender there are ['ATTRIBUTE']" in found


def findings_after(blender, file, change, folder):
    """What is found when the stage that Blender imports is compared with a changed one."""
    layer = Sdf.Layer.CreateAnonymous(".usdc")
    layer.TransferContent(Sdf.Layer.FindOrOpen(str(file)))
    change(Usd.Stage.Open(layer))
    layer.Export(str(folder / "changed.usdc"))
    return "\n".join(blender("compare:compare_stage", file, expected=folder / "changed.usdc").findings)


def test_the_comparison_can_be_run_on_any_stage(written):
    file = written("air, flat")
    words = [sys.executable, "-m", "tests.blender.compare", str(file)]
    done = subprocess.run(words, capture_output=True, text=True, check=True, cwd=ROOT)
    assert f"{file}: 1 selections, 8 frames, 0 differences" in done.stdout
