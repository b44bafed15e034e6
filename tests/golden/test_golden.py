"""Two small recipes are held to their stages in `stages/`: structure exactly, numbers within a tolerance.

`balloon-usd golden update` writes those anew that are meant to differ; `stages/golden.yaml` has the tolerances.
"""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from click.testing import CliRunner
from pxr import Usd

from balloon_usd.cli import main
from balloon_usd.diff import Allowed, Tolerances, compare_files
from balloon_usd.diff.report import diff_text
from balloon_usd.golden import read_list
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.stage.properties import check_stage

if TYPE_CHECKING:
    from collections.abc import Callable

    from balloon_usd.balloon.detail import Detail
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Strip

    Find = Callable[[str], Path]

STAGES = Path(__file__).parents[2] / "stages"
GOLDEN = read_list(STAGES)
recipes = pytest.mark.parametrize("name", GOLDEN)


def half(allowed: Allowed) -> Allowed:
    return Allowed(0.5 * allowed.absolute, 0.5 * allowed.relative)


def half_of_what_is_tolerated(name: str) -> Tolerances:
    kept = GOLDEN[name].tolerances
    assert kept.rms is not None
    return Tolerances(half(kept.general), {key: half(kept.named[key]) for key in kept.named}, 0.5 * kept.rms)


def test_every_recipe_beside_this_file_has_a_golden_stage() -> None:
    beside = {file.resolve() for file in Path(__file__).parent.glob("*.yaml")}
    assert {entry.recipe.resolve() for entry in GOLDEN.values()} == beside


def test_the_recipes_give_their_golden_stages() -> None:
    result = CliRunner().invoke(main, ["golden", "verify", "--stages", str(STAGES)])
    assert result.exit_code == 0, result.output
    assert result.stdout == "".join(f"{name}: the same\n" for name in GOLDEN)


@recipes
def test_points_and_means_of_every_frame_are_held(name: str) -> None:
    tolerances = GOLDEN[name].tolerances
    assert tolerances.rms is not None
    assert tolerances.rms < 0.5 * tolerances.named["points"].absolute


@recipes
def test_a_golden_stage_has_every_property_of_a_stage(name: str) -> None:
    assert check_stage(Usd.Stage.Open(str(STAGES / name / f"{name}.usda"))) == []


@recipes
def test_two_runs_give_the_same_bytes(name: str, fresh: Find, tmp_path: Path) -> None:
    recipe = Path(__file__).with_name(f"{name}.yaml")
    words = ["run", str(recipe), "-o", str(tmp_path), "--device", "cpu", "--no-preview"]
    subprocess.run([sys.executable, "-m", "balloon_usd", *words], check=True, capture_output=True)
    first = fresh(name).parent
    files = sorted(file.relative_to(first) for file in first.rglob("*") if file.is_file())
    assert len(files) == 7
    for file in files:
        assert (first / file).read_bytes() == (tmp_path / name / file).read_bytes(), file


@recipes
def test_rounding_errors_do_half_of_what_is_tolerated(
    name: str, fresh: Find, performed: Find, monkeypatch: pytest.MonkeyPatch
) -> None:
    exact = fresh(name)
    monkeypatch.setattr("balloon_usd.plan.meshing.mesh_of", mesh_with_rounding_errors)
    tolerances = half_of_what_is_tolerated(name)
    found = compare_files(performed(name), exact, tolerances=tolerances, variants=True)
    assert diff_text(found) == "no difference"


def mesh_with_rounding_errors(strip: Strip, detail: Detail) -> BalloonMesh:
    """The mesh of a balloon, each coordinate one unit in the last place up or down."""
    mesh = mesh_of(strip, detail)
    away = np.where(np.random.default_rng(7).random(mesh.points.shape) < 0.5, -np.inf, np.inf)
    return replace(mesh, points=np.nextafter(mesh.points, away.astype(np.float32)))
