"""The experiments of the thesis (Kosaka 2008, chapter 4): recipes performed once, and what is measured of their frames.

One balloon each. Lengths in m, times in s.
"""

from __future__ import annotations

import math
import re
import time
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import islice
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.tube_mesh import BalloonMesh
from balloon_usd.operations.moves import Move
from balloon_usd.plan import Plan, plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.frame import Frame
from balloon_usd.solver.kosaka.model import KosakaModel
from balloon_usd.solver.kosaka.parameters import Parameters
from balloon_usd.solver.simulation import simulate_many
from balloon_usd.solver.status import COMES_UNDONE
from tests.crossing import deepest_crossing

Floats = NDArray[np.float64]
Ints = NDArray[np.intp]

FOLDER = Path(__file__).parents[2] / "recipes" / "kosaka"
EXPERIMENTS = ("diffusion", "press", "bubble", "bubbles", "bend")
"""Recipes of the experiments 4.2.1 to 4.2.4."""
NEAR = 0.015
"""Distance within which the solid angle of a face is taken exactly, m: three widths of a face."""
DEEPEST = 1.0
"""Deepest that a wall may lie inside another, mm."""
SLABS, SHELLS = 8, 2
"""Cells of equal volume for the density of air; a shell is no thinner than the distance of two particles."""


@dataclass(frozen=True, eq=False)
class Run:
    """A plan of one balloon, performed."""

    plan: Plan
    mesh: BalloonMesh
    frames: tuple[Frame, ...]
    law: Parameters | None
    """Constants of the model `kosaka`."""
    repairs: int
    """How often particles were brought back, all together."""
    milliseconds: float
    """Time that a frame takes: the median."""

    @cached_property
    def points(self) -> Floats:
        """Vertices of all frames, (F, V, 3)."""
        return np.array([frame.points[0] for frame in self.frames], dtype=np.float64)

    @property
    def fps(self) -> float:
        """Frames per second."""
        return self.plan.recipe.fps

    @property
    def last_second(self) -> slice:
        """The frames of the last second in which nothing comes undone."""
        held = sum(not frame.doing.startswith("comes undone") for frame in self.frames)
        return slice(held - round(self.fps), held)

    def frame_at(self, seconds: float) -> int:
        """Index of the frame that shows a time."""
        return round(seconds * self.fps)

    def move(self, kind: type[Move]) -> Move:
        """The first move of a kind."""
        return next(move for move in self.plan.choreography.moves if type(move) is kind)

    def sampled(self, every: int = 5) -> list[int]:
        """Indices of some frames; the last one is among them."""
        last = len(self.frames) - 1
        return sorted({*range(0, last, every), last})


def recipe(name: str) -> str:
    """Text of an experiment's recipe."""
    return (FOLDER / f"{name}.yaml").read_text(encoding="utf-8")


def bend_recipe(factor: float) -> str:
    """Text of the recipe that bends, with so many times its force."""
    force = re.compile(r"force: ([\d.]+) N")
    return force.sub(lambda found: f"force: {factor * float(found[1]):g} N", recipe("bend"))


def perform(text: str, device: str = "cpu", most: int | None = None) -> Run:
    """Perform a recipe, or its first `most` frames."""
    made = plan(Recipe.parse(text))
    simulation = simulate_many([made], detail="draft", device=device)
    frames, ticks = [], [time.perf_counter()]
    for (frame,) in islice(simulation.frames(), most):
        assert isinstance(frame, Frame), frame
        frames.append(frame)
        ticks.append(time.perf_counter())
    scene = simulation.model.scene if isinstance(simulation.model, KosakaModel) else None
    return Run(
        plan=made,
        mesh=simulation.meshes[0][0],
        frames=tuple(frames),
        law=scene.bodies[0].parameters if scene else None,
        repairs=int(scene.repairs.numpy().sum()) if scene else 0,
        milliseconds=1e3 * float(np.median(np.diff(ticks))),
    )


@cache
def performed(text: str) -> Run:
    """A recipe performed on the CPU, once for all tests."""
    return perform(text)


def deepest_wall(name: str) -> float:
    """How deep a wall lies inside another in the last frame of a recipe, mm."""
    run = performed(recipe(name))
    return 1e3 * float(deepest_crossing([(run.frames[-1].points[0], run.mesh.quads)]).depth)


# --- air


def winding(places: Floats, x: Floats, quads: NDArray[np.int32]) -> Floats:
    """Winding number of a wall round some places (P, 3), (P,): 1 inside, 0 outside, between in an opening.

    Solid angles of near faces are exact (Van Oosterom & Strackee 1983), far ones count as points.
    """
    corners = x[quads]
    area = 0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    away = corners.mean(axis=1) - places[:, None]
    far = np.linalg.norm(away, axis=2)
    with np.errstate(divide="ignore", invalid="ignore"):
        solid = np.einsum("pqi,qi->pq", away, area) / far**3
    place, quad = np.nonzero(far < NEAR)
    seen = corners[quad] - places[place, None]
    solid[place, quad] = _solid_angle(seen[:, [0, 1, 2]]) + _solid_angle(seen[:, [0, 2, 3]])
    return np.asarray(solid.sum(axis=1) / (4.0 * math.pi))


def _solid_angle(triangles: Floats) -> Floats:
    """Solid angles of triangles (N, 3, 3) seen from the origin."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    la, lb, lc = (np.linalg.norm(corner, axis=1) for corner in (a, b, c))
    ab, bc, ca = ((p * q).sum(axis=1) for p, q in ((a, b), (b, c), (c, a)))
    return np.asarray(
        2.0 * np.arctan2((a * np.cross(b, c)).sum(axis=1), la * lb * lc + ab * lc + bc * la + ca * lb)
    )


def cluster_quads(run: Run, k: int, cluster: int) -> NDArray[np.int32]:
    """Faces of one cluster in a frame: those of its first bubble and of all that are not parted from it yet."""
    clusters = np.unique(run.frames[k].cluster[0])
    of_quad = clusters[np.searchsorted(clusters, run.mesh.quad_bubble, side="right") - 1]
    return np.asarray(run.mesh.quads[of_quad == cluster])


@cache
def outside(run: Run, k: int) -> Ints:
    """Particles that are outside their bubble in a frame: round them its wall winds less than half."""
    air, clusters = run.frames[k].air[0].astype(np.float64), run.frames[k].cluster[0]
    found = []
    for cluster in np.unique(clusters):
        members = np.flatnonzero(clusters == cluster)
        turns = winding(air[members], run.points[k], cluster_quads(run, k, cluster))
        found.append(members[turns < 0.5])
    return np.concatenate(found)


def told(run: Run, k: int) -> str:
    """Where the particles are that are outside their bubble in a frame."""
    frame, x = run.frames[k], run.points[k]
    clusters = np.unique(frame.cluster[0])
    lines = []
    for p in outside(run, k):
        here = frame.air[0][p].astype(np.float64)
        own = int(frame.cluster[0][p])
        away = 1e3 * np.linalg.norm(x[cluster_quads(run, k, own)].mean(axis=1) - here, axis=1).min()
        joint = [f"{1e3 * np.linalg.norm(middle(run, x, s) - here):.1f}" for s in joints(run)]
        others = [c for c in clusters if winding(here[None], x, cluster_quads(run, k, c))[0] > 0.5]
        lines.append(
            f"  particle {p} of bubble {own} at ({', '.join(f'{1e3 * c:.1f}' for c in here)}) mm, "
            f"in {f'bubble {others[0]}' if others else 'no bubble'}, {away:.1f} mm from the nearest face's middle, "
            f"{', '.join(joint) or 'no'} mm from joints"
        )
    head = f"frame {frame.time_code} ({frame.doing}): {len(lines)} of {len(frame.air[0])} outside"
    return "\n".join([head, *lines])


def unevenness(run: Run, k: int) -> float:
    """Coefficient of variation of the air's density over cells of equal volume of a straight capsule."""
    x, air = run.points[k], run.frames[k].air[0].astype(np.float64)
    ring = rings(run, x)
    centre = ring.mean(axis=1)
    axis = (centre[-1] - centre[0]) / np.linalg.norm(centre[-1] - centre[0])
    along, wide = (centre - centre[0]) @ axis, ring_diameters(ring) / 2.0
    ends = (x - centre[0]) @ axis
    fine = np.linspace(ends.min(), ends.max(), 4000)
    radius = np.interp(fine, [fine[0], *along, fine[-1]], [0.0, *wide, 0.0])
    volume = np.cumsum(radius**2)
    place = (air - centre[0]) @ axis
    from_axis = np.linalg.norm(air - centre[0] - place[:, None] * axis, axis=1)
    slab = SLABS * np.interp(place, fine, volume / volume[-1])
    shell = SHELLS * (from_axis / np.maximum(np.interp(place, fine, radius), 1e-6)) ** 2
    cell = np.clip(slab.astype(int), 0, SLABS - 1) * SHELLS + np.clip(shell.astype(int), 0, SHELLS - 1)
    count = np.bincount(cell, minlength=SLABS * SHELLS)
    return float(count.std() / count.mean())


# --- rubber


def rings(run: Run, x: Floats) -> Floats:
    """All rings of the balloon, (R, around, 3)."""
    return np.asarray(x[run.mesh.ring_start[:, None] + np.arange(run.mesh.around)])


def ring_diameters(ring: Floats) -> Floats:
    """Diameters of the circles that have the area of these rings (R, around, 3), (R,)."""
    arm = ring - ring.mean(axis=1, keepdims=True)
    area = 0.5 * np.linalg.norm(np.cross(arm, np.roll(arm, -1, axis=1)).sum(axis=1), axis=1)
    return np.asarray(2.0 * np.sqrt(area / math.pi))


def joints(run: Run) -> list[float]:
    """Unstressed places of the joints between bubbles."""
    return [bubble.rest_end for bubble in run.plan.bubbles[:-1]]


def middle(run: Run, x: Floats, along: float) -> Floats:
    """Middle of the ring at an unstressed place, (3,)."""
    return np.asarray(rings(run, x)[run.mesh.ring_at(along)].mean(axis=0))


def neck_radii(run: Run, x: Floats) -> Floats:
    """Largest distance of a vertex from the middle of its joint, for every joint."""
    ring = rings(run, x)[[run.mesh.ring_at(s) for s in joints(run)]]
    return np.asarray(np.linalg.norm(ring - ring.mean(axis=1, keepdims=True), axis=2).max(axis=1))


def bubble_lengths(run: Run, x: Floats) -> Floats:
    """Distance from neck to neck of every bubble; of the outermost from knot, pole or tip."""
    capsule = next(iter(run.plan.strips.values())).capsule
    ends = [middle(run, x, s) for s in joints(run)]
    start = x[run.mesh.along.argmin()] if capsule else middle(run, x, 0.0)
    ends = [start, *ends, x[run.mesh.along.argmax()]]
    return np.asarray(np.linalg.norm(np.diff(ends, axis=0), axis=1))


def bubble_diameters(run: Run, x: Floats) -> Floats:
    """Diameter of the widest ring of every bubble."""
    wide = ring_diameters(rings(run, x))
    inside = [
        (run.mesh.ring_along > bubble.rest_start) & (run.mesh.ring_along < bubble.rest_end)
        for bubble in run.plan.bubbles
    ]
    return np.array([wide[here].max() for here in inside])


def bubble_middle(run: Run, x: Floats, bubble: int) -> Floats:
    """Mean of a bubble's vertices, (3,)."""
    return np.asarray(x[np.unique(run.mesh.quads[run.mesh.quad_bubble == bubble])].mean(axis=0))


def trembling(run: Run) -> tuple[float, float]:
    """How the wall moves in the last second: root of the mean square of its speed (m/s), and of its distance from
    where it is on average (m), until joints come undone.
    """
    undone = sum(frame.doing.startswith(COMES_UNDONE) for frame in run.frames)
    last = run.last_second
    x = run.points[last.start - undone : -undone or None]
    speed = np.diff(x, axis=0) * run.fps
    off = x - x.mean(axis=0)
    rms = [float(np.sqrt((d**2).sum(axis=2).mean())) for d in (speed, off)]
    return rms[0], rms[1]


def moved_back(x: Floats, goal: Floats) -> Floats:
    """Points (V, 3) moved as a rigid body as near to others (V, 3) as can be (Kabsch 1976)."""
    here, there = x - x.mean(axis=0), goal - goal.mean(axis=0)
    u, _, vt = np.linalg.svd(here.T @ there)
    u[:, -1] *= np.sign(np.linalg.det(u @ vt))
    return np.asarray(here @ (u @ vt) + goal.mean(axis=0))
