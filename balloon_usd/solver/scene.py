"""The flat state: all balloons of all sculptures in one set of device arrays."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.solver.device_arrays import DeviceArrays
from balloon_usd.solver.flat_bodies import FlatBodies
from balloon_usd.solver.flatten import Arrays, chunk_arrays, mesh_arrays, ring_arrays, segment_arrays
from balloon_usd.solver.kernels.arrays.rows import SPINS, TARGETS, Touch
from balloon_usd.solver.kernels.arrays.shared import (
    Balloons,
    Checks,
    Contacts,
    Hands,
    Joints,
    Mesh,
    Sculptures,
    State,
    Welds,
)

if TYPE_CHECKING:
    import warp as wp

    from balloon_usd.solver.kernels.arrays.table import Size

NO_LIMIT = 1.0e38
"""Stretch above any other: no limit."""
SELF_DISTANCE = 0.6
"""Unstressed distance along one bubble within which its wall never meets itself, R0: two rows of a crease in
`draft`.
"""
OPPOSITE_DISTANCE = 4.0
"""Unstressed distance along one bubble within which the inside of its wall may meet itself, R0: a tube that
is pressed flat, but not one that is bent to a ring.
"""
SHARED = (Balloons, Checks, Contacts, Hands, Joints, Mesh, Sculptures, State, Welds)
"""Structs of arrays that scenes of all models have."""


@dataclass
class Scene(FlatBodies):
    """Bodies flattened into arrays on one device."""

    arrays: DeviceArrays = field(init=False)
    """Device arrays by their names in the table."""
    touch: Touch = field(default_factory=Touch)

    def __post_init__(self) -> None:
        """Know the sizes that the bodies have; there are no arrays yet."""
        vertices, quads = int(self.vertex_start[-1]), int(self.quad_start[-1])
        worlds = max(self.worlds) + 1
        sizes: dict[Size, int] = {
            "balloons": len(self.bodies),
            "balloon starts": len(self.bodies) + 1,
            "contacts": TARGETS * vertices,
            # Device arrays are never empty: a scene without rings gets one that does nothing.
            "joints": max(1, int(self.joint_start[-1])),
            "quads": quads,
            "sculptures": worlds,
            "sculpture starts": worlds + 1,
            "segments": int(self.segment_start[-1]),
            "segment starts": int(self.segment_start[-1]) + 1,
            "spins": SPINS * worlds,
            "triangles": 2 * quads,
            "vertices": vertices,
        }
        self.arrays = DeviceArrays(self.device, sizes)

    def __getattr__(self, name: str) -> wp.array[Any]:
        """Return a device array by its name."""
        try:
            found: wp.array[Any] = self.__dict__["arrays"][name]
        except KeyError:
            raise AttributeError(name) from None
        return found


def lay_meshes(scene: Scene, host: Arrays, weld_count: int) -> None:
    """Put what all models share on the device: meshes, rings, hands, welds and contact.

    `host`: arrays of the model so far, among them `mass` (V,), kg. `weld_count`: capacity for welds.
    """
    mesh_arrays(scene, host)
    ring_arrays(scene, host)
    segment_arrays(scene, host)
    chunk_arrays(scene, host)
    points = np.concatenate([b.points for b in scene.bodies]).astype(np.float32)
    joints = np.arange(len(host["joint_first"]), dtype=np.int32)
    scene.arrays.put(host | {"x": points, "x_next": points, "x_checked": points, "joint_leader": joints})
    scene.arrays.fill("stretch_limit", NO_LIMIT)
    scene.arrays.fill("target", -1)
    scene.arrays.set_size("welds", max(1, weld_count))
    scene.arrays.zero_others(*SHARED)
    scene.touch.pressure = scene.settings.contact_pressure
    scene.touch.margin = 0.5 * scene.settings.contact_offset
    scene.touch.apart = SELF_DISTANCE
    scene.touch.across = OPPOSITE_DISTANCE
