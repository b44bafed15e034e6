"""The flat state: all balloons of all sculptures in one set of device arrays."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp

from balloon_usd.plan.welding import MOST_WELDED
from balloon_usd.solver.flat_bodies import FlatBodies
from balloon_usd.solver.flatten import Arrays, chunk_arrays, mesh_arrays, ring_arrays, segment_arrays
from balloon_usd.solver.kernels.physics.contact import HITS, TARGETS, Touch
from balloon_usd.solver.kernels.physics.fingers import Finger

if TYPE_CHECKING:
    from numpy.typing import NDArray

NO_LIMIT = 1.0e38
"""Stretch above any other: no limit."""
SELF_DISTANCE = 1.0
"""Unstressed distance along one bubble within which its wall never meets itself, R0."""


@dataclass
class Scene(FlatBodies):
    """Bodies flattened into arrays on one device."""

    arrays: dict[str, Any] = field(default_factory=dict)
    """Device arrays by the names that the kernels give them."""
    touch: Touch = field(default_factory=Touch)

    def __getattr__(self, name: str) -> Any:
        """Return a device array by its name."""
        try:
            return self.__dict__["arrays"][name]
        except KeyError:
            raise AttributeError(name) from None

    def put(self, host: Arrays) -> None:
        """Put host arrays on the device under their names."""
        for name, values in host.items():
            self.arrays[name] = wp.array(values, dtype=_dtype(name, values), device=self.device)

    def zeros(self, name: str, shape: int | tuple[int, ...], dtype: Any) -> None:
        """Make an array of zeros on the device."""
        self.arrays[name] = wp.zeros(shape, dtype=dtype, device=self.device)


def lay_meshes(scene: Scene, host: Arrays, weld_count: int) -> None:
    """Put what all models share on the device: meshes, rings, hands, welds and contact.

    `host`: arrays of the model so far, among them `mass` (V,), kg. `weld_count`: capacity for welds.
    """
    mesh_arrays(scene, host)
    ring_arrays(scene, host)
    segment_arrays(scene, host)
    chunk_arrays(scene, host)
    scene.put(host)
    _motion_arrays(scene)
    _contact_arrays(scene)
    _hand_arrays(scene, max(1, weld_count))


def _motion_arrays(scene: Scene) -> None:
    vertices, a = int(scene.vertex_start[-1]), scene.arrays
    points = np.concatenate([b.points for b in scene.bodies]).astype(np.float32)
    for name in ("x", "x_next", "x_checked"):
        a[name] = wp.array(points, dtype=wp.vec3, device=scene.device)
    a["stretch_limit"] = wp.full(len(scene.bodies), NO_LIMIT, dtype=float, device=scene.device)
    scene.zeros("suspects", max(scene.worlds) + 1, int)
    scene.zeros("v", vertices, wp.vec3)
    scene.zeros("stretch", vertices, float)
    scene.zeros("volume", int(scene.segment_start[-1]), float)


def _contact_arrays(scene: Scene) -> None:
    vertices, quads, a = int(scene.vertex_start[-1]), int(scene.quad_start[-1]), scene.arrays
    for name, count in (("normal", vertices), ("quad_middle", quads), ("quad_area", quads)):
        scene.zeros(name, count, wp.vec3)
    for name in ("chunk_low", "chunk_high"):
        scene.zeros(name, len(a["chunk_quad"]) - 1, wp.vec3)
    scene.zeros("area", vertices, float)
    scene.zeros("vertex_own", vertices, wp.vec2i)
    scene.zeros("ring_radius", len(a["ring_first"]), float)
    scene.zeros("slip", (vertices, TARGETS), wp.vec3)
    scene.zeros("contact_force", (TARGETS * 3, vertices), float)
    scene.zeros("contact_place", vertices * TARGETS, wp.vec2)
    a["target"] = wp.full((vertices, TARGETS), -1, dtype=int, device=scene.device)
    scene.zeros("touching", len(scene.bodies), int)
    scene.zeros("hit_count", quads, int)
    scene.zeros("hits", (quads, HITS), int)
    # Compact lists: contacts as 2 * vertex + target, and quads that are touched.
    scene.zeros("pairs", TARGETS * vertices, int)
    scene.zeros("pressed", quads, int)
    for name in ("most_hits", "pair_count", "pressed_count"):
        scene.zeros(name, max(scene.worlds) + 1, int)
    scene.touch.offset = scene.settings.contact_offset
    scene.touch.pressure = scene.settings.contact_pressure
    scene.touch.margin = 0.5 * scene.settings.contact_offset
    scene.touch.apart = SELF_DISTANCE


def _hand_arrays(scene: Scene, welds: int) -> None:
    joints = len(scene.arrays["joint_first"])
    for name in (
        "ring_middle",
        "ring_area",
        "ring_velocity",
        "hand_load",
        "hand_from",
        "hand_to",
        "hand_free",
    ):
        scene.zeros(name, joints, wp.vec3)
    for name in ("radius_from", "radius_to", "hand_force", "hand_stiffness"):
        scene.zeros(name, joints, float)
    scene.zeros("hand", joints, int)
    scene.zeros("fingers", len(scene.bodies), Finger)
    scene.zeros("finger_share", int(scene.vertex_start[-1]), float)
    scene.zeros("weld_joint", (welds, MOST_WELDED), int)
    scene.zeros("weld_size", welds, int)
    scene.zeros("weld_reach", welds, float)
    scene.zeros("weld_gap", welds, float)
    scene.zeros("joint_weld", joints, int)
    scene.put({"joint_leader": np.arange(joints, dtype=np.int32)})
    scene.zeros("weld_shift", joints, wp.vec3)
    scene.zeros("world_welds", max(scene.worlds) + 1, int)


_VECTORS = {
    "quads": wp.vec4i,
    "corners": wp.vec4i,
    "rest_inverse": wp.mat22,
    "hourglass": wp.vec4,
    "ring_cos_sin": wp.vec2,
    "joint_beside": wp.vec2i,
    "air": wp.vec3,
    "vertex_place": wp.vec3,
    "quad_place": wp.vec3,
    "spring_ends": wp.vec4i,
    "natural": wp.vec4,
}


def _dtype(name: str, values: NDArray[Any]) -> Any:
    if name in _VECTORS:
        return _VECTORS[name]
    return {"int32": wp.int32, "float64": wp.float64, "float32": wp.float32}[str(values.dtype)]
