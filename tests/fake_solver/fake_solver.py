"""A simulation without physics, in worker processes too: the flat balloons, drifting upwards."""

from __future__ import annotations

import json
import os
import pickle
import signal
import time
from dataclasses import replace
from itertools import accumulate, pairwise
from pathlib import Path

import numpy as np

from balloon_usd.balloon.detail import detail_named
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.solver.errors import SimulationFailed
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.frame_arrays import Extent, Place
from balloon_usd.solver.snapshot import Change, Snapshot

LONGEST_PAUSE = 60.0
"""Longest time that a pretended simulation waits for a test, s."""
FRAMES = 6
HERE = Path(__file__).parent


class FakeSimulation:
    """What `simulate_many` returns; `trouble` by recipe name happens at frame 3."""

    def __init__(self, plans, detail, device, solver):
        self.plans = tuple(plans)
        self.meshes = [
            tuple(mesh_of(strip, detail_named(detail)) for strip in plan.strips.values()) for plan in plans
        ]
        self.frame_counts = tuple(solver.frame_count for _ in plans)
        self.device = device
        self.solver = solver
        self.substeps = 100

    @property
    def extent(self):
        vertices = sum(len(mesh.points) for meshes in self.meshes for mesh in meshes)
        return Extent(vertices, sum(len(plan.bubbles) for plan in self.plans))

    @property
    def places(self):
        found, vertices, bubbles = [], 0, 0
        for plan, meshes in zip(self.plans, self.meshes, strict=True):
            ends = [*accumulate((len(mesh.points) for mesh in meshes), initial=vertices)]
            walls = tuple(slice(*span) for span in pairwise(ends))
            found.append(Place(walls, slice(bubbles, bubbles + len(plan.bubbles))))
            vertices, bubbles = ends[-1], bubbles + len(plan.bubbles)
        return found

    def snapshots(self, memory=None):
        places = self.places
        for code, outcomes in enumerate(self.frames(), start=1):
            arrays = (memory or self.extent.frame_arrays)()
            changes = []
            for world, (outcome, place) in enumerate(zip(outcomes, places, strict=True)):
                if isinstance(outcome, SimulationFailed):
                    changes.append(Change(world, "pinch: nose", (), outcome))
                elif outcome is not None:
                    changes.append(Change(world, outcome.doing, outcome.undone))
                    there = arrays.frame(place, code)
                    for kind in ("points", "stretch"):
                        for array, other in zip(getattr(there, kind), getattr(outcome, kind), strict=True):
                            array[...] = other
                    there.pressure[...], there.volume[...] = outcome.pressure, outcome.volume
                    there.contact[...] = 0.0
            made = np.array([isinstance(outcome, Frame) for outcome in outcomes])
            yield Snapshot(code, arrays, made, changes)

    def frames(self):
        try:
            for code in range(1, max(self.frame_counts) + 1):
                self.given = code
                yield [self._frame(world, code) for world in range(len(self.plans))]
        finally:
            self.solver.log({"given": self.given, "plans": [plan.recipe.name for plan in self.plans]})

    def _frame(self, world, code):
        plan, meshes = self.plans[world], self.meshes[world]
        trouble = self.solver.trouble.get(plan.recipe.name)
        if code == 3 and isinstance(trouble, str):
            self._act(trouble, plan.recipe.name)
        if code == 3 and isinstance(trouble, BaseException):
            raise trouble
        if isinstance(trouble, tuple):
            return (
                SimulationFailed(*trouble)
                if code == 3
                else None
                if code > 3
                else self._made(plan, meshes, code)
            )
        frame = self._made(plan, meshes, code, undone=trouble == "undone")
        return replace(frame, points=tuple(map(folded, frame.points))) if trouble == "fold" else frame

    def _act(self, trouble, name):
        if trouble == "sleep":
            print("asleep", flush=True)
            time.sleep(60)
        kill_if("kill", name)
        most = {"out of memory": 2, "out of memory alone": 0}.get(trouble)
        if most is not None and len(self.plans) > most and self.device != "cpu":
            raise RuntimeError(f"Failed to allocate 123 bytes on device '{self.device}'")
        lost = trouble == "device is lost" or (
            trouble == "first device is lost" and self.solver.first_time(name)
        )
        if lost and self.device != "cpu":
            self.solver.lose(self.device)
            raise RuntimeError("Warp CUDA error 719: unspecified launch failure")
        if trouble == "slow":
            time.sleep(0.3)
        end = time.monotonic() + LONGEST_PAUSE
        while trouble == "pause" and not self.solver.goes_on and time.monotonic() < end:
            time.sleep(0.01)

    def _made(self, plan, meshes, code, *, undone=False):
        lift = np.float32([0, 0, 0.01 * code])
        bubbles = np.full(len(plan.bubbles), 1e-4, dtype=np.float32)
        return Frame(
            code,
            tuple(mesh.points + lift for mesh in meshes),
            tuple(np.ones(len(mesh.points), dtype=np.float32) for mesh in meshes),
            bubbles * 1e7,
            bubbles,
            "pinch: nose",
            undone=("nose.end", "middle.end") if undone else (),
        )


def folded(points):
    """A tube whose one half lies in the other."""
    middle = np.float32(0.5) * (points[:, 0].min() + points[:, 0].max())
    over = points.copy()
    over[points[:, 0] > middle] += np.float32([0.0, 0.002, 0.001])
    over[:, 0] = np.abs(points[:, 0] - middle)
    return over


class FakeSolver:
    """Stands in for `simulate_many`; what it is told and does lies in a folder, which other processes know."""

    def __init__(self, folder, frame_count=FRAMES):
        self.folder = Path(folder)
        self.folder.mkdir(exist_ok=True)
        self.frame_count = frame_count

    @classmethod
    def of_environment(cls):
        return cls(os.environ["FAKE_SOLVER"], int(os.environ["FAKE_FRAMES"]))

    @property
    def trouble(self):
        """What befalls recipes by name: an exception, arguments of `SimulationFailed`, or a word."""
        file = self.folder / "trouble"
        return pickle.loads(file.read_bytes()) if file.exists() else {}

    @trouble.setter
    def trouble(self, trouble):
        (self.folder / "trouble").write_bytes(pickle.dumps(trouble))

    def first_time(self, name):
        """Whether this was not asked of a name before."""
        try:
            (self.folder / f"{name}.once").touch(exist_ok=False)
        except FileExistsError:
            return False
        return True

    def go_on(self):
        """Let what pauses go on."""
        (self.folder / "goes_on").touch()

    @property
    def goes_on(self):
        return (self.folder / "goes_on").exists()

    def lose(self, device):
        """Let a pretended GPU be gone from now on."""
        (self.folder / f"{device}.lost").touch()

    def has_lost(self, device):
        return (self.folder / f"{device}.lost").exists()

    def log(self, entry):
        with (self.folder / "log").open("a") as file:
            file.write(json.dumps(entry) + "\n")

    @property
    def calls(self):
        """Simulations so far: the names of their recipes."""
        return [entry["start"] for entry in self._entries() if "start" in entry]

    @property
    def given(self):
        """Frames that simulations gave out, in the order in which they ended."""
        return [entry["given"] for entry in self._entries() if "given" in entry]

    def _entries(self):
        file = self.folder / "log"
        return [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []

    def __call__(self, plans, detail="draft", device="cpu", threads=None):
        simulation = FakeSimulation(plans, detail, device, self)
        self.log({"start": [plan.recipe.name for plan in plans], "device": device, "process": os.getpid()})
        return simulation


def kill_if(trouble, name):
    """Kill this process if that is what befalls a recipe, always or "once"."""
    solver = FakeSolver.of_environment()
    found = solver.trouble.get(name)
    if found == trouble or (found == f"{trouble} once" and solver.first_time(name)):
        os.kill(os.getpid(), signal.SIGKILL)
