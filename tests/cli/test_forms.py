from __future__ import annotations

import pytest
from pxr import Usd, UsdGeom, UsdShade

from balloon_usd.cli.form import LOOKS, WITH_AIR
from balloon_usd.stage.looks import looks_of
from tests.stage.capsule import Capsule
from tests.stage.tubes import sculpture

SPRINGS = """\
format: 1
name: springs
units: cm
balloons:
  main: {size: 260, color: red, capsule: 20}
steps:
  - bubbles: {bubble: 8}
  - rest: rest
physics:
  model: kosaka
"""


def material_of(stage, name):
    mesh = next(prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh))
    bound, _ = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()
    assert str(bound.GetPath()).startswith(f"/{name}/mtl/")
    return bound.GetPrim().GetName()


def test_usdz_writes_one_package(cli, solver, write_recipe, left):
    result = cli("run", write_recipe(), "-o", "out", "--usdz", "--no-report", "--device", "cpu")
    assert result.exit_code == 0, result.output
    assert left() == ["snake.png", "snake.usdz"]
    assert "stage out/snake.usdz" in result.stdout
    assert UsdGeom.GetStageUpAxis(Usd.Stage.Open("out/snake.usdz")) == "Y"


def test_a_shot_stands_beside_the_stage(cli, solver, write_recipe, left):
    for form, stage in (((), "snake/snake.usda"), (("--flat",), "snake.usdc")):
        result = cli("run", write_recipe(), "-o", "out", "--shot", "--no-report", "--no-preview", *form)
        assert result.exit_code == 0, result.output
        assert {stage, "snake_shot.usda"} <= {*left()}
        shot = Usd.Stage.Open("out/snake_shot.usda")
        assert shot.GetPrimAtPath("/shot/sculpture/geo/render/main").IsA(UsdGeom.Mesh)


@pytest.mark.parametrize("form", ["", "--flat", "--usdz"])
def test_a_look_can_be_chosen(form, cli, solver, write_recipe, left):
    words = ["run", write_recipe(), "-o", "out", "--look", "chrome", "--no-report", "--no-preview"]
    assert cli(*words, *([form] if form else [])).exit_code == 0
    file = {"": "snake/snake.usda", "--flat": "snake.usdc", "--usdz": "snake.usdz"}[form]
    assert material_of(Usd.Stage.Open(f"out/{file}"), "snake") == "chrome_red"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--flat", "--usdz"), "--flat and --usdz: choose one of them, or neither for a folder"),
        (
            ("--usdz", "--shot"),
            "--usdz and --shot: choose one of them, a shot refers to a folder or to --flat",
        ),
        (("--look", "crome"), '--look: unknown look "crome", did you mean "chrome"?'),
        (
            ("--look", "wood"),
            '--look: unknown look "wood", expected one of recipe, clear, chrome, clay, print, stress, thesis',
        ),
        (
            ("--look", "thesis"),
            "snake.yaml: --look thesis needs model: kosaka, take one of recipe, clear, chrome, clay, print, stress",
        ),
    ],
)
def test_what_does_not_go_together_is_told_in_one_line_and_nothing_is_run(
    words, message, cli, solver, write_recipe, left
):
    write_recipe()
    result = cli("run", "snake.yaml", "-o", "out", *words)
    assert (result.exit_code, result.stderr) == (2, f"{message}\n")
    assert solver.calls == []
    assert left() == []


def test_a_package_has_no_look_that_needs_a_texture(cli, solver, write_recipe, left):
    result = cli("run", write_recipe(text=SPRINGS), "-o", "out", "--usdz", "--look", "thesis")
    assert (result.exit_code, result.stderr) == (
        2,
        "--look thesis: a usdz holds no textures, take recipe\n",
    )
    assert left() == []


@pytest.mark.parametrize(("word", "name"), [("--usdz", "snake.usdz"), ("--shot", "snake_shot.usda")])
def test_a_folder_in_the_place_of_a_file_is_named_before_the_simulation(
    word, name, cli, solver, write_recipe, tmp_path
):
    (tmp_path / "out" / name).mkdir(parents=True)
    result = cli("run", write_recipe(), "-o", "out", word)
    assert (result.exit_code, result.stderr) == (2, f"out/{name}: a folder is in the way\n")
    assert solver.calls == []


def test_the_command_line_knows_all_looks():
    assert looks_of(sculpture()) == LOOKS
    assert looks_of(Capsule().describe()) == (*LOOKS, WITH_AIR)
