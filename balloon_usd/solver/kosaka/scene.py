"""The flat state of the thesis's model: nets of springs and particles of air added to the meshes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import warp as wp

from balloon_usd.solver.kernels.arrays.kosaka import Faces, Net, Particles
from balloon_usd.solver.kernels.arrays.rows import Constants
from balloon_usd.solver.kosaka.parameters import FASTEST_AIR, MARGIN
from balloon_usd.solver.scene import Scene, lay_meshes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.solver.flat_bodies import Ints
    from balloon_usd.solver.flatten import Arrays
    from balloon_usd.solver.kosaka.body import KosakaBody
    from balloon_usd.solver.settings import SceneSettings

NEIGHBOURS = {"cpu": 512, "cuda": 2048}
"""Capacity for the neighbours of one particle; on a GPU it is split among the lanes of a block."""
FACE_AIR = {"cpu": 1536, "cuda": 2048}
"""Capacity for the particles that may touch one quad, likewise."""
AIR_FACES = {"cpu": 3072, "cuda": 6144}
"""Capacity for the triangles that one particle may touch, likewise: in a neck most of them fall to one lane.
"""
WATCHED = 2.0
"""Distance within which walls are watched between two searches, in thicknesses of the contact region."""
SELF_DISTANCE = 1.0
"""Unstressed distance along one capsule within which its wall never meets itself, radii."""


@dataclass
class KosakaScene(Scene):
    """Balloons of springs and particles on one device."""

    bodies: tuple[KosakaBody, ...]
    margin: float = 0.0
    """Margin (skin) of the neighbour lists, m."""

    @cached_property
    def air_start(self) -> Ints:
        """First particle of every body, (B + 1,)."""
        return np.concatenate([[0], np.cumsum([len(b.air) for b in self.bodies])])


def kosaka_scene(
    bodies: Sequence[KosakaBody], worlds: Sequence[int], settings: SceneSettings, device: str
) -> KosakaScene:
    """Put bodies on a device; bodies of different `worlds` never touch."""
    scene = KosakaScene.of(bodies, worlds, settings, device)
    scene.margin = MARGIN * min(b.parameters.re for b in bodies)
    mass = np.concatenate([np.full(len(b.points), b.vertex_mass) for b in bodies]).astype(np.float32)
    lay_meshes(scene, {"mass": mass}, sum(len(b.rings) for b in bodies))
    # Contact alone keeps walls apart here.
    scene.crossed.fill_(1)
    scene.touch.apart = SELF_DISTANCE
    scene.touch.margin = WATCHED * settings.contact_offset
    host: Arrays = {}
    _net_arrays(scene, host)
    _air_arrays(scene, host)
    _set_sizes(scene)
    scene.arrays.put(host)
    constants = [_constants(b, settings.dt) for b in bodies]
    scene.arrays["constants"] = wp.array(constants, dtype=Constants, device=device)
    scene.arrays.zero_others(Faces, Net, Particles)
    return scene


def _net_arrays(scene: KosakaScene, host: Arrays) -> None:
    starts = scene.vertex_start
    host["spring_ends"] = np.concatenate(
        [np.where(b.net.ends >= 0, b.net.ends + starts[k], -1) for k, b in enumerate(scene.bodies)]
    ).astype(np.int32)
    host["natural"] = np.concatenate([b.net.natural for b in scene.bodies]).astype(np.float32)
    host["joint_neck"] = np.array(
        [b.neck_radius for b in scene.bodies for _ in b.rings] or [1.0], dtype=np.float32
    )
    host["frozen"] = np.array([r.closed for b in scene.bodies for r in b.rings] or [False], dtype=np.int32)


def _air_arrays(scene: KosakaScene, host: Arrays) -> None:
    bodies = scene.bodies
    counts = [len(b.air) for b in bodies]
    first = [int(scene.segment_start[k]) + b.spare_segments for k, b in enumerate(bodies)]
    host["pressure_per_hit"] = np.array([b.vertex_mass * b.push / 6.0 for b in bodies], dtype=np.float32)
    host["air"] = np.concatenate([b.air for b in bodies]).astype(np.float32)
    host["air_balloon"] = np.repeat(np.arange(len(bodies)), counts).astype(np.int32)
    host["air_world"] = np.asarray(scene.worlds, dtype=np.int32)[host["air_balloon"]]
    host["balloon_quads"] = scene.quad_start.astype(np.int32)
    host["air_cluster"] = np.repeat(first, counts).astype(np.int32)
    segment = scene.quad_segment.numpy()
    # One run of bubbles until a ring freezes; the knot's own segments stay by themselves.
    host["quad_cluster"] = np.minimum(segment, np.asarray(first)[scene.quad_balloon.numpy()]).astype(np.int32)


def _constants(body: KosakaBody, dt: float) -> Constants:
    constants, law = Constants(), body.parameters
    for name in (
        "ks",
        "kd",
        "alpha",
        "beta",
        "gamma",
        "re",
        "air_offset",
        "contact_offset",
        "leak_offset",
        "calming",
        "grading",
        "drag",
        "force_limit",
        "elongation_limit",
    ):
        setattr(constants, name, getattr(law, name))
    constants.push = body.push
    constants.air_speed = FASTEST_AIR * body.parameters.re / dt
    return constants


def _set_sizes(scene: KosakaScene) -> None:
    """Set how many particles there are and how long the lists of what may touch are."""
    kind = scene.device.partition(":")[0]
    scene.arrays.set_size("particles", int(scene.air_start[-1]))
    scene.arrays.set_size("slots for neighbours", NEIGHBOURS[kind])
    scene.arrays.set_size("slots for particles", FACE_AIR[kind])
    scene.arrays.set_size("slots for faces", AIR_FACES[kind])
