"""The state of a scene and the arrays that kernels hand on to each other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import warp as wp

from balloon_usd.solver.device_law import device_law
from balloon_usd.solver.kernels.contact import HITS, TARGETS
from balloon_usd.solver.kernels.joints import Axes
from balloon_usd.solver.kernels.motion import Spin
from balloon_usd.solver.kernels.rubber import Law

if TYPE_CHECKING:
    from balloon_usd.solver.scene import Scene

STRUT_SLOTS = 24
"""Struts that may end at one joint."""
WELD_SLOTS = 16
"""Joints that one weld may hold together."""


def state_arrays(scene: Scene, weld_count: int, strut_count: int) -> None:
    """Make the state and scratch arrays of a scene, at rest."""
    device, a = scene.device, scene.arrays
    vertices, quads = int(scene.vertex_start[-1]), int(scene.quad_start[-1])
    segments, joints, balloons = int(scene.segment_start[-1]), len(a["joint_first"]), len(scene.bodies)

    def zeros(name: str, shape: int | tuple[int, ...], dtype: type) -> None:
        a[name] = wp.zeros(shape, dtype=dtype, device=device)

    points = np.concatenate([b.points for b in scene.bodies]).astype(np.float32)
    a["x"], a["x_next"] = (wp.array(points, dtype=wp.vec3, device=device) for _ in range(2))
    for name, count in (("v", vertices), ("normal", vertices), ("quad_middle", quads), ("quad_area", quads)):
        zeros(name, count, wp.vec3)
    for name, count in (
        ("area", vertices),
        ("ring_radius", len(a["ring_first"])),
        ("stretch", vertices),
    ):
        zeros(name, count, float)
    worked = np.concatenate([b.worked for b in scene.bodies]).astype(np.float32)
    a["peak_energy"] = wp.array(worked, dtype=float, device=device)
    a["softening_rate"] = wp.full(balloons, 1.0, dtype=float, device=device)
    for name in ("volume", "pressure"):
        zeros(name, segments, float)
    zeros("amount", segments, wp.float64)
    zeros("corner_force", (quads, 4), wp.vec3)
    zeros("slip", (vertices, TARGETS), wp.vec3)
    zeros("contact_force", (vertices, TARGETS), wp.vec3)
    zeros("contact_share", (vertices, TARGETS), wp.vec4)
    a["target"] = wp.full((vertices, TARGETS), -1, dtype=int, device=device)
    zeros("touching", balloons, int)
    zeros("hit_count", quads, int)
    zeros("hits", (quads, HITS), int)
    zeros("most_hits", max(scene.worlds) + 1, int)
    for name in ("ring_middle", "ring_area", "ring_speed", "hand_load", "hand_from", "hand_to", "hand_free"):
        zeros(name, joints, wp.vec3)
    for name in ("radius_from", "radius_to", "open_from", "open_to", "hand_force", "hand_stiffness"):
        zeros(name, joints, float)
    zeros("hand", joints, int)
    zeros("ring_axes", joints, Axes)
    zeros("joint_struts", (joints, STRUT_SLOTS), int)
    zeros("spin", balloons, Spin)
    zeros("pump_flow", balloons, float)
    zeros("pump_limit", balloons, float)
    zeros("pump_goal", balloons, wp.float64)
    zeros("weld_joint", (max(1, weld_count), WELD_SLOTS), int)
    zeros("weld_size", max(1, weld_count), int)
    zeros("weld_reach", max(1, weld_count), float)
    zeros("weld_gap", max(1, weld_count), float)
    a["strut_joint"] = wp.full(max(1, strut_count), wp.vec2i(-1, -1), dtype=wp.vec2i, device=device)
    for name in ("strut_stiffness", "strut_damping", "strut_yield", "strut_length"):
        zeros(name, max(1, strut_count), float)
    zeros("strut_force", max(1, strut_count), wp.vec3)
    laws = [device_law(b.rubber, scene.settings.dt) for b in scene.bodies]
    a["laws"] = wp.array(laws, dtype=Law, device=device)
