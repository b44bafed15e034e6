"""Two small recipes are held to their stages in `stages/`: structure exactly, numbers within a tolerance.

`python -m pytest tests/golden --update-golden` writes the golden stages anew.
"""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from pxr import Usd

from balloon_usd.plan.meshing import mesh_of
from balloon_usd.stage import differences
from balloon_usd.stage.properties import check_stage

if TYPE_CHECKING:
    from collections.abc import Callable

    from balloon_usd.balloon.detail import Detail
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Strip

    Find = Callable[[str], Path]


def tolerance(points: float, stretch: float, pressure: float, volume: float) -> dict[str, float]:
    """Tolerances by attribute: points in m, stretch and pressure as a share, volume in m3."""
    return {
        "points": points,
        "extent": points,
        "extentsHint": points,
        "primvars:stretch": stretch,
        "primvars:pressure": pressure,
        "balloon_usd:pressure": pressure,
        "balloon_usd:volume": volume,
    }


# Four times what an error of one unit in the last place of every flat vertex did to the result at most in
# eight runs, rounded. Without wall on wall it stays at micrometres, also where twists come undone. Once walls
# press and slip on each other it decides which fold beside a neck snaps over first: a few vertices then
# differ by a millimetre, all together by a quarter of one. The target of the compiler (generic or native)
# changed no bit.
TOLERANCES = {
    "caterpillar": tolerance(points=2e-5, stretch=1e-4, pressure=1e-4, volume=2e-9),
    "pair": tolerance(points=4e-3, stretch=4e-2, pressure=4e-2, volume=1.2e-7),
}
ROOT_MEAN_SQUARE = {"caterpillar": 8e-6, "pair": 1.2e-3}
"""Tolerance of the distance between the points of one frame, m, as the root of the mean square."""
recipes = pytest.mark.parametrize("name", TOLERANCES)


def found(one: Path, other: Path, name: str, share: float = 1.0) -> str:
    """The first differences, a line each, beyond a share of the recipe's tolerance."""
    stages = [Usd.Stage.Open(str(file)) for file in (one, other)]
    allowed = {key: share * value for key, value in TOLERANCES[name].items()}
    return "\n".join(list(differences(*stages, tolerance=allowed))[:10])


def root_mean_square(one: Path, other: Path, name: str) -> list[float]:
    """How far the points of two stages are apart, frame by frame, m."""
    stages = [Usd.Stage.Open(str(file)) for file in (one, other)]
    points = [stage.GetAttributeAtPath(f"/{name}/geo/render/main.points") for stage in stages]
    gaps = [np.subtract(*(np.asarray(p.Get(time)) for p in points)) for time in points[0].GetTimeSamples()]
    return [float(np.sqrt((gap**2).sum(axis=1).mean())) for gap in gaps]


@recipes
def test_a_recipe_gives_its_golden_stage(name: str, golden: Find, fresh: Find) -> None:
    assert found(golden(name), fresh(name), name) == ""


@recipes
def test_the_points_of_every_frame_lie_where_they_did(name: str, golden: Find, fresh: Find) -> None:
    distances = root_mean_square(golden(name), fresh(name), name)
    assert max(distances) < ROOT_MEAN_SQUARE[name], f"frame {1 + int(np.argmax(distances))}"


@recipes
def test_a_golden_stage_has_every_property_of_a_stage(name: str, golden: Find) -> None:
    assert check_stage(Usd.Stage.Open(str(golden(name)))) == []


@recipes
def test_two_runs_give_the_same_bytes(name: str, fresh: Find, tmp_path: Path) -> None:
    recipe = Path(__file__).with_name(f"{name}.yaml")
    words = ["run", str(recipe), "-o", str(tmp_path), "--device", "cpu", "--no-preview"]
    subprocess.run([sys.executable, "-m", "balloon_usd", *words], check=True, capture_output=True)
    first = fresh(name).parent
    files = sorted(file.relative_to(first) for file in first.rglob("*") if file.is_file())
    assert len(files) == 5
    for file in files:
        assert (first / file).read_bytes() == (tmp_path / name / file).read_bytes(), file


@recipes
def test_rounding_errors_do_half_of_what_is_tolerated(
    name: str, fresh: Find, performed: Find, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("balloon_usd.solver.simulation.mesh_of", mesh_with_rounding_errors)
    nudged = performed(name)
    assert found(nudged, fresh(name), name, share=0.5) == ""
    assert max(root_mean_square(nudged, fresh(name), name)) < 0.5 * ROOT_MEAN_SQUARE[name]


def mesh_with_rounding_errors(strip: Strip, detail: Detail) -> BalloonMesh:
    """The mesh of a balloon, each coordinate one unit in the last place up or down."""
    mesh = mesh_of(strip, detail)
    away = np.where(np.random.default_rng(7).random(mesh.points.shape) < 0.5, -np.inf, np.inf)
    return replace(mesh, points=np.nextafter(mesh.points, away.astype(np.float32)))
