"""Every shipped recipe, made once at draft detail."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from balloon_usd.plan import Plan, plan
from balloon_usd.quality.watch import QualityWatch
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.run_summary import RunSummary
from balloon_usd.solver.simulation import Simulation, simulate_many
from balloon_usd.stage import StageWriter
from balloon_usd.staging import describe_stage

RECIPES = sorted((Path(__file__).parents[2] / "recipes").glob("*.yaml"))
QUICK = ("dog", "flower", "rabbit")
"""Those that are not left to long tests: one that stands, one that hands hold, one with long ears."""


@dataclass(frozen=True)
class Made:
    """A finished sculpture."""

    plan: Plan
    simulation: Simulation
    joints: np.ndarray
    """Middles of all planned rings in every frame from the let-go until hands set the figure straight,
    (frames, rings, 3), m.
    """
    last: Frame
    summary: RunSummary
    quality: dict
    """As `QualityWatch.data` gives it."""
    stage: Path
    """Its stage with all looks, and a shot beside it."""


def middles(simulation: Simulation, frame: Frame) -> np.ndarray:
    """Middles of all planned rings of a sculpture, (rings, 3), m."""
    plan = simulation.plans[0]
    names = list(plan.strips)
    found = []
    for ring in plan.table.rings:
        balloon = names.index(ring.balloon)
        mesh = simulation.meshes[0][balloon]
        first = mesh.ring_start[mesh.ring_at(ring.along)]
        found.append(frame.points[balloon][first : first + mesh.around].mean(axis=0))
    return np.array(found)


@cache
def make(path: Path, folder: Path) -> Made:
    """Make a recipe, keep what its tests look at, and write its stage into a folder."""
    planned = plan(Recipe.load(path))
    simulation = simulate_many([planned], detail="draft", device="cpu")
    choreography = planned.choreography
    let_go, taken_up = (int(t * simulation.fps) for t in (choreography.let_go, choreography.taken_up))
    summary, joints = RunSummary(planned, simulation.meshes[0]), []
    quality = QualityWatch(planned, simulation.meshes[0])
    frame = None
    with StageWriter(describe_stage(planned, simulation.meshes[0]), folder, shot=True) as writer:
        for frames in simulation.frames():
            frame = frames[0]
            assert isinstance(frame, Frame), f"{path.name}: {frame}"
            summary.add(frame)
            quality.add(frame)
            writer.write(frame)
            if let_go < frame.time_code <= taken_up + 1:
                joints.append(middles(simulation, frame))
        written = writer.finish()
    assert frame is not None
    return Made(planned, simulation, np.array(joints), frame, summary, quality.data(), written.files[0])


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("sculptures")


@pytest.fixture(
    params=[
        pytest.param(path, id=path.stem, marks=() if path.stem in QUICK else pytest.mark.long)
        for path in RECIPES
    ],
    scope="module",
)
def made(request: pytest.FixtureRequest, folder: Path) -> Made:
    return make(request.param, folder)


@pytest.fixture(scope="module")
def dog(folder: Path) -> Made:
    return make(next(path for path in RECIPES if path.stem == "dog"), folder)
