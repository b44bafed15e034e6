"""The thesis's model of some plans: bodies, performers and stepper in one flat state."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.plan.parking import parked
from balloon_usd.solver.body import body_ranges
from balloon_usd.solver.checks import stretch_limits
from balloon_usd.solver.frame_arrays import FrameArrays
from balloon_usd.solver.hands import Hands
from balloon_usd.solver.kosaka.body import KosakaBody, kosaka_body
from balloon_usd.solver.kosaka.clusters import Clusters
from balloon_usd.solver.kosaka.motions.table import KOSAKA_MOTIONS
from balloon_usd.solver.kosaka.parameters import RUBBER_DRAG, SUBSTEPS
from balloon_usd.solver.kosaka.scene import KosakaScene, kosaka_scene
from balloon_usd.solver.kosaka.sculpture import KosakaSculpture
from balloon_usd.solver.kosaka.stepper import KosakaStepper
from balloon_usd.solver.layout import Layout
from balloon_usd.solver.model import Model
from balloon_usd.solver.performer import Performer
from balloon_usd.solver.readback import Readback
from balloon_usd.solver.settings import SceneSettings

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.detail import Detail
    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan

READ_BACK = (
    "x",
    "stretch",
    "volume",
    "cluster_pressure",
    "most_near",
    "air",
    "ring_middle",
    "fastest",
    "suspects",
)
"""Arrays that are read back for every frame."""


MOST_SEARCHES = 2
"""Searches for neighbours in a frame in which hands are at work or air moves fast."""
AHEAD = 0.5
"""Way of the fastest air after which neighbour lists are rebuilt, in their margin."""
FIRST_FRAMES = 6
"""Frames at the start in which air moves as fast as it may."""
LEADING = 0.1
"""Force of a hand that leads a bubble, as a share of the largest external force."""
LEAK_SEARCH_EVERY = 12
"""Frames between two searches for air that no offset region sees, while no hand is at work."""
LAST_PASSES = 4
"""Searches for it in the frame in which a sculpture ends."""
ROOM_TO_GROW = 1.25
"""Largest size of a quad, in its size at the start, up to which the searches are sure to find it."""


class _ClusterState(NamedTuple):
    """The clusters when the state was read back."""

    of_segment: NDArray[np.int64]
    """Cluster of every segment, (S,)."""
    of_air: NDArray[np.int32]
    """Cluster of every particle, (P,)."""


class KosakaModel(Model):
    """Sculptures of springs and air particles."""

    def __init__(
        self,
        plans: Sequence[Plan],
        meshes: Sequence[Sequence[BalloonMesh]],
        fps: float,
        substeps: int,
        device: str,
        threads: int = 1,  # noqa: ARG002  # its kernels have tiles, which threads would share
    ) -> None:
        runs = body_ranges([len(m) for m in meshes])
        dt = 1.0 / (fps * substeps)
        bodies = [body for plan, m in zip(plans, meshes, strict=True) for body in _bodies(plan, m, dt)]
        worlds = [world for world, run in enumerate(runs) for _ in run]
        settings = SceneSettings(
            dt=dt,
            gravity=plans[0].recipe.gravity,
            drag=RUBBER_DRAG,
            contact_offset=min(b.parameters.contact_offset for b in bodies),
        )
        self.scene = kosaka_scene(bodies, worlds, settings, device)
        self.scene.stretch_limit.assign(stretch_limits(plans, runs))
        readback = Readback(self.scene, READ_BACK)
        self.stepper = KosakaStepper(self.scene, substeps, _quad_half(bodies), readback)
        self.hands = _hands(self.scene)
        self.clusters = Clusters(self.scene)
        self._lengths = [plan.choreography.seconds for plan in plans]
        starts = self.scene.air_start
        layout = Layout(self.scene, runs, np.diff(starts).tolist())
        sizes = [starts[run.stop] - starts[run.start] for run in runs]
        self._first_bubble = np.repeat([place.bubbles.start for place in layout.places], sizes)
        """First bubble of the sculpture of every particle."""
        self._read_clusters = self._cluster_state()
        self._frames = 0
        self._moved = 0.0
        """Way of the fastest air since the last rebuild of the neighbour lists, in their margin."""
        performers = [
            Performer(KosakaSculpture(plan, self.scene, self.hands, run.start), KOSAKA_MOTIONS)
            for plan, run in zip(plans, runs, strict=True)
        ]
        super().__init__(self.hands, performers, runs, layout, readback)

    @staticmethod
    def usual_substeps(_detail: Detail) -> int:
        """Return the substeps of a frame at 24 frames per second."""
        return SUBSTEPS

    def _start_physics(self, begin: float, end: float, _middle: NDArray[np.float32]) -> None:
        self.hands.upload()
        handled = self.hands.pressing or bool(self.hands.mode.any())
        self._frames += 1
        self.stepper.advance(
            contact=self.hands.contact,
            fingers=self.hands.pressing,
            searches=self._searches(end - begin, handled=handled),
            rings=self.clusters.closed or bool(self.hands.mode.any() or self.hands.radius_goal.any()),
        )
        self.hands.arrived()
        self.clusters.part(self.hands.radius_goal > 0.0)
        for _ in range(self._passes(begin, end, handled=handled)):
            self.stepper.find_leaked()
        self.stepper.start_readback()

    def _searches(self, seconds: float, *, handled: bool) -> int:
        """Rebuilds of the neighbour lists that a frame of some seconds needs: more where hands are at work or
        air moves fast, none while all motion stays within their margin.
        """
        step = float(self._state["fastest"][0]) * seconds / self.scene.margin
        if handled or self._frames <= FIRST_FRAMES or step > AHEAD:
            self._moved = step
            return MOST_SEARCHES
        self._moved += step
        if self._moved <= AHEAD:
            return 0
        self._moved = step
        return 1

    def _passes(self, begin: float, end: float, *, handled: bool) -> int:
        """How often leaked air is searched for in this frame: what was brought back where a sculpture ends
        must not have come through another wall.
        """
        if any(begin < seconds < end + 0.5 * (end - begin) for seconds in self._lengths):
            return LAST_PASSES
        return int(handled or self._frames % LEAK_SEARCH_EVERY == 0)

    def read_back(self) -> None:
        """Wait for the read-back of the latest state: what follows is of that state, until the next
        read-back.
        """
        if self._frames == 0:
            self.stepper.start_readback()
        super().read_back()
        self._read_clusters = self._cluster_state()

    def _cluster_state(self) -> _ClusterState:
        return _ClusterState(self.clusters.of_segment, self.clusters.of_air)

    @property
    def frame_arrays(self) -> FrameArrays:
        """Arrays of the state read back last, of all sculptures; valid for two more read-backs."""
        state, bubbles = self._state, self.layout.bubbles
        pressure = state["cluster_pressure"][self._read_clusters.of_segment[bubbles]]
        cluster = np.searchsorted(bubbles, self._read_clusters.of_air) - self._first_bubble
        return FrameArrays(
            state["x"],
            state["stretch"],
            pressure,
            state["volume"][bubbles],
            air=state["air"],
            cluster=cluster.astype(np.int32),
        )

    def failures(self) -> dict[int, str]:
        """Return failures that the frames do not show, by sculpture."""
        most_near = self._state["most_near"]
        return {world: _too_near(int(most_near[world])) for world in np.flatnonzero(most_near).tolist()}


def _too_near(near: int) -> str:
    return f"about {near} air particles and faces meet, more than there is room for: space them wider"


def _hands(scene: KosakaScene) -> Hands:
    """Hands as strong as the external forces of the model may be (Kosaka 2008, 3.1)."""
    hands = Hands(scene, lead_stiffness=math.inf)
    limits = np.repeat([b.parameters.force_limit for b in scene.bodies], [len(b.rings) for b in scene.bodies])
    hands.force[:] = LEADING * limits * scene.joint_mass.numpy()
    hands.upload()
    return hands


def _bodies(plan: Plan, meshes: Sequence[BalloonMesh], dt: float) -> list[KosakaBody]:
    """Return the balloons of a plan, where they lie at the start."""
    bodies, places = [], parked(plan.strips)
    for strip, mesh in zip(plan.strips.values(), meshes, strict=True):
        scale = strip.size.thickness / strip.size.radius
        pressure = maxwell_state(strip.rubber).p_star * scale
        body = kosaka_body(strip, plan.table, mesh, plan.recipe.physics.kosaka, pressure, dt)
        body.points[:, 1] += places[strip.balloon]
        body.air[:, 1] += places[strip.balloon]
        bodies.append(body)
    return bodies


def _quad_half(bodies: Sequence[KosakaBody]) -> float:
    """Largest distance of a quad's corner from its middle, m, with room to grow."""
    corners = [b.points[b.quads] - b.points[b.quads].mean(axis=1, keepdims=True) for b in bodies]
    return ROOM_TO_GROW * max(float(np.linalg.norm(c, axis=2).max()) for c in corners)
