"""V27: a finished sculpture at draft, preview and full detail, and with its substeps halved.

There is no theory to compare with: coarser meshes are held against the finest. Joints are where they are by their
distances from each other, and gas is that of the bubbles that were twisted off. The rest is told apart, since it
holds what all others have left.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest
import warp as wp
from numpy.typing import NDArray

from balloon_usd.balloon.detail import detail_named
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.simulation import simulate_many
from tests.joints import joint_distances
from tests.verification.free_fingers import free_fingers

HEAD = """
format: 1
name: head
units: cm
balloons:
  main: {size: 260, length: 12, tail: 6, color: red}
steps:
  - bubbles: {nose: 5, left_ear: 6, right_ear: 6}
  - lock: [left_ear, right_ear]
    point: up
  - rest: tail
"""
DOG = (Path(__file__).parents[2] / "recipes" / "dog.yaml").read_text(encoding="utf-8")
HOLD = 0.5
"""Time for which the finished sculpture is left alone before it is measured, s."""


@dataclass(frozen=True)
class Sculpture:
    """A recipe, and how far a detail may be from full detail, and from itself with substeps half as long."""

    name: str
    recipe: str
    gas: dict[str, float]
    """Largest difference of the volumes by detail, root mean square over the bubbles, %."""
    rest: dict[str, float]
    """The same of the rest, %."""
    joints: dict[str, float]
    """The same of the distances between joints, mm."""


SMALL = Sculpture(
    "head",
    HEAD,
    gas={"draft": 3.0, "preview": 0.6},
    rest={"draft": 3.0, "preview": 1.0},
    joints={"draft": 1.0, "preview": 0.5},
)
LARGE = Sculpture(
    "dog",
    DOG,
    gas={"draft": 4.0, "preview": 1.5},
    rest={"draft": 5.0, "preview": 2.5},
    joints={"draft": 3.0, "preview": 1.5},
)
CASES = [
    (SMALL, "cpu"),
    *((sculpture, device.alias) for device in wp.get_cuda_devices() for sculpture in (SMALL, LARGE)),
]
"""What is made where: the dog in full detail takes minutes on a CPU."""


@dataclass(frozen=True)
class Finished:
    """What is measured of the last frame."""

    volume: NDArray[np.float64]
    """Of every bubble, the rest last, m3."""
    distances: NDArray[np.float64]
    """Between all joints, m."""


@cache
def finished(recipe: str, detail: str, substeps: int, device: str) -> Finished:
    """Make a sculpture with so many substeps in a frame."""
    planned = plan(Recipe.parse(f"{recipe}physics: {{hold: {HOLD}, substeps: {substeps}}}\n"))
    simulation = simulate_many([planned], detail=detail, device=device)
    with free_fingers():
        *_, (frame,) = simulation.frames()
    assert isinstance(frame, Frame), frame
    return Finished(frame.volume.astype(np.float64), joint_distances(simulation, frame))


@pytest.fixture(params=CASES, ids=lambda case: f"{case[0].name}-{case[1]}")
def case(request):
    return request.param


def made(case, detail, finer=1):
    sculpture, device = case
    return finished(sculpture.recipe, detail, finer * detail_named(detail).substeps, device)


def gas_apart(one, other):
    """Difference of the volumes of twisted bubbles, root mean square, %."""
    return 100.0 * np.sqrt(np.mean((one.volume / other.volume - 1.0)[:-1] ** 2))


def rest_apart(one, other):
    """Difference of the volumes of the rest, %."""
    return 100.0 * abs(one.volume[-1] / other.volume[-1] - 1.0)


def joints_apart(one, other):
    """Difference of the distances between joints, root mean square, mm."""
    return 1e3 * np.sqrt(np.mean((one.distances - other.distances) ** 2))


MEASURES = {"gas": gas_apart, "rest": rest_apart, "joints": joints_apart}
UNITS = {"gas": "gas, rms, %", "rest": "gas of the rest, %", "joints": "joints, rms, mm"}


@pytest.mark.long
@pytest.mark.parametrize("detail", ["draft", "preview"])
@pytest.mark.parametrize("what", MEASURES)
def test_a_coarser_sculpture_is_that_of_full_detail_within_what_is_stated(verify, case, what, detail):
    sculpture, _ = case
    found = MEASURES[what](made(case, detail), made(case, "full"))
    quantity = f"{sculpture.name}, {detail} against full, {UNITS[what]}"
    verify("V27", quantity, found, 0.0, getattr(sculpture, what)[detail])


@pytest.mark.long
@pytest.mark.parametrize("what", ["gas", "joints"])
def test_a_finer_mesh_is_nearer_to_the_finest(verify, case, what):
    apart = MEASURES[what]
    coarse, fine = (apart(made(case, detail), made(case, "full")) for detail in ("draft", "preview"))
    verify("V27b", f"{case[0].name}, {what}, preview off full, in draft off full", fine / coarse, 0.0, 1.0)


@pytest.mark.parametrize("detail", ["draft", pytest.param("preview", marks=pytest.mark.long)])
@pytest.mark.parametrize("what", MEASURES)
def test_half_a_substep_changes_no_more_than_is_stated_for_the_detail(verify, case, what, detail):
    sculpture, _ = case
    found = MEASURES[what](made(case, detail, finer=2), made(case, detail))
    quantity = f"{sculpture.name}, {detail}, half a substep, {UNITS[what]}"
    verify("V27c", quantity, found, 0.0, getattr(sculpture, what)[detail])
