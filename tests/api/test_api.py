"""The Python API, as a user types it."""

from __future__ import annotations

import pickle
import subprocess
import sys
from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import balloon_usd
from balloon_usd import (
    DeviceUnavailable,
    Frame,
    Plan,
    Recipe,
    RecipeBuilder,
    SimulationFailed,
    StageError,
    plan_recipe,
    simulate,
    simulate_many,
    write_stage,
)

if TYPE_CHECKING:
    from pathlib import Path


@pytest.fixture
def recipe() -> Recipe:
    """A tiny balloon with one twist."""
    return (
        RecipeBuilder("bud", fps=8)
        .balloon("main", size=260, length=0.05, tail=0.02)
        .bubbles(head=0.05)
        .rest("tail")
        .physics(hold=0.1)
        .build()
    )


@pytest.fixture
def plan(recipe: Recipe) -> Plan:
    return plan_recipe(recipe)


def test_importing_the_package_loads_nothing_heavy() -> None:
    code = "import sys, balloon_usd; print({'warp', 'pxr', 'networkx', 'numpy', 'PIL'} & {*sys.modules})"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout.strip() == "set()"


@pytest.mark.parametrize("name", balloon_usd.__all__)
def test_every_public_name_is_there(name: str) -> None:
    assert getattr(balloon_usd, name)
    assert name in dir(balloon_usd)


def test_an_unknown_name_is_told() -> None:
    with pytest.raises(AttributeError, match="no attribute 'simulator'"):
        _ = balloon_usd.simulator


def test_a_plan_is_performed_frame_by_frame_and_written(plan: Plan, tmp_path: Path) -> None:
    frames = simulate(plan, device="cpu")
    assert [len(mesh.points) for mesh in frames.meshes] == [len(next(frames).points[0])]
    rest = list(islice(frames, 4))
    assert all(isinstance(frame, Frame) and np.isfinite(frame.points[0]).all() for frame in rest)
    assert [frame.time_code for frame in rest] == [2, 3, 4, 5]
    written = write_stage(plan, rest, tmp_path)
    assert written.files[0] == tmp_path / "bud" / "bud.usda"
    assert written.frames == 4


def test_a_performance_has_as_many_frames_as_it_says(plan: Plan) -> None:
    frames = simulate(plan, device="cpu")
    assert len(list(frames)) == frames.frame_count


def test_one_plan_alone_moves_as_it_does_among_many(plan: Plan) -> None:
    alone = list(islice(simulate(plan, device="cpu"), 6))
    among = [frames[1] for frames in islice(simulate_many([plan, plan], device="cpu").frames(), 6)]
    for one, other in zip(alone, among, strict=True):
        assert np.array_equal(one.points[0], other.points[0])


def test_frames_of_another_detail_are_refused(plan: Plan, tmp_path: Path) -> None:
    frames = list(islice(simulate(plan, device="cpu"), 1))
    with pytest.raises(StageError, match="expected float32"):
        write_stage(plan, frames, tmp_path, detail="full")
    assert list(tmp_path.iterdir()) == []


def test_the_detail_of_a_performance_is_taken_over(plan: Plan, tmp_path: Path) -> None:
    written = write_stage(plan, simulate(plan, detail="preview", device="cpu"), tmp_path, flat=True)
    assert written.files == (tmp_path / "bud.usdc",)


@pytest.mark.parametrize(
    ("choices", "files"),
    [
        ({"look": "chrome", "usdz": True}, ["bud.usdz"]),
        ({"look": "stress", "flat": True, "shot": True}, ["bud.usdc", "bud_shot.usda"]),
    ],
)
def test_form_and_look_of_a_stage_can_be_chosen(
    choices: dict[str, Any], files: list[str], plan: Plan, tmp_path: Path
) -> None:
    written = write_stage(plan, islice(simulate(plan, device="cpu"), 2), tmp_path, **choices)
    assert [file.name for file in written.files] == files


def test_a_look_that_a_stage_cannot_have_is_told(plan: Plan, tmp_path: Path) -> None:
    with pytest.raises(StageError, match='has no look "crome", did you mean "chrome"'):
        write_stage(plan, simulate(plan, device="cpu"), tmp_path, look="crome")
    assert list(tmp_path.iterdir()) == []


def test_a_failed_simulation_is_raised_and_leaves_no_stage(
    plan: Plan, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("balloon_usd.solver.checks.FASTEST", 0.0)
    with pytest.raises(SimulationFailed, match=r"inflate: main: a part of tail moves"):
        write_stage(plan, simulate(plan, device="cpu"), tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("detail", "device", "error"), [("fine", "cpu", "unknown detail"), ("draft", "cuda:99", "no device")]
)
def test_a_wrong_choice_is_told(detail: str, device: str, error: str, plan: Plan) -> None:
    with pytest.raises((ValueError, balloon_usd.DeviceUnavailable), match=error):
        simulate(plan, detail=detail, device=device)


def test_frames_of_another_plan_are_not_written(plan: Plan, recipe: Recipe, tmp_path: Path) -> None:
    other = plan_recipe(Recipe.parse(recipe.to_yaml().replace("name: bud", "name: leaf")))
    with pytest.raises(StageError, match='the frames show another plan, that of "leaf"'):
        write_stage(plan, simulate(other, device="cpu"), tmp_path)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("folder", ["x" * 300, "a\0b", "a\udcffb"])
def test_a_folder_that_can_have_no_stage_is_told(plan: Plan, tmp_path: Path, folder: str) -> None:
    with pytest.raises(StageError, match="could not be written"):
        write_stage(plan, simulate(plan, device="cpu"), tmp_path / folder)


def test_plans_may_come_one_by_one_and_threads_are_counted_from_one(plan: Plan) -> None:
    assert simulate_many((each for each in [plan]), device="cpu").frame_counts == (plan.frame_count,)
    with pytest.raises(ValueError, match="0 threads, expected at least 1"):
        simulate_many([plan], device="cpu", threads=0)


def test_errors_travel_between_processes() -> None:
    failed = pickle.loads(pickle.dumps(SimulationFailed("twist", 1.5, "it bursts", 37)))
    assert (failed.step, failed.time, failed.cause, failed.frame) == ("twist", 1.5, "it bursts", 37)
    assert str(failed) == "at 1.50 s (frame 37), twist: it bursts"
    missing = pickle.loads(pickle.dumps(DeviceUnavailable("cuda:7", ["cpu"])))
    assert str(missing) == 'there is no device "cuda:7", only cpu'
