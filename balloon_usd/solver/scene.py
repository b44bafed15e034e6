"""The flat state: all balloons of all sculptures in one set of device arrays."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from balloon_usd.balloon.air import AIR_DENSITY, GAS_CONSTANT, ROOM_TEMPERATURE
from balloon_usd.solver.flatten import Arrays, gas_arrays, mesh_arrays, ring_arrays
from balloon_usd.solver.kernels.contact import Touch
from balloon_usd.solver.kernels.gas import Air
from balloon_usd.solver.membrane_data import membrane_data
from balloon_usd.solver.state import state_arrays

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.solver.body import Body
    from balloon_usd.solver.settings import SceneSettings

DISCHARGE = 0.6
"""Discharge coefficient of a sharp orifice."""
EQUALISE = 0.9
"""Largest share of a pressure difference that may even out in one substep, between rigid walls: stable."""
SELF_DISTANCE = 1.0
"""Unstressed distance along one bubble within which its wall never meets itself, R0."""


Ints = NDArray[np.int64]


@dataclass
class Scene:
    """Bodies flattened into arrays on one device; indices are global over all bodies."""

    bodies: tuple[Body, ...]
    worlds: tuple[int, ...]
    """Sculpture of every body."""
    settings: SceneSettings
    device: str
    vertex_start: Ints
    """First vertex of every body, (B + 1,); the same for the others."""
    quad_start: Ints
    """First quad of every body."""
    segment_start: Ints
    """First chamber of every body."""
    joint_start: Ints
    """First ring of every body."""
    arrays: dict[str, Any] = field(default_factory=dict)
    """Device arrays by the names that the kernels give them."""
    air: Air = field(default_factory=Air)
    touch: Touch = field(default_factory=Touch)

    def __getattr__(self, name: str) -> Any:
        """Return a device array by its name."""
        try:
            return self.__dict__["arrays"][name]
        except KeyError:
            raise AttributeError(name) from None


def build_scene(
    bodies: Sequence[Body],
    worlds: Sequence[int],
    settings: SceneSettings,
    device: str,
    weld_count: int,
    strut_count: int,
) -> Scene:
    """Put bodies on a device.

    `worlds`: sculpture of every body; bodies of different sculptures never touch. `weld_count`,
    `strut_count`: room for
    welds and struts.
    """
    vertices, quads, segments, joints = (np.concatenate([[0], np.cumsum(n)]) for n in _sizes(bodies))
    scene = Scene(tuple(bodies), tuple(worlds), settings, device, vertices, quads, segments, joints)
    data = [
        membrane_data(b, settings.dt, settings.atmosphere, scale_mass=settings.scale_mass) for b in bodies
    ]
    host: Arrays = {}
    mesh_arrays(scene, data, host)
    ring_arrays(scene, data, host)
    gas_arrays(scene, host)
    for name, values in host.items():
        scene.arrays[name] = wp.array(values, dtype=_dtype(name, values), device=device)
    state_arrays(scene, weld_count, strut_count)
    scene.touch.offset = settings.contact_offset
    scene.touch.pressure = settings.contact_pressure
    scene.touch.margin = 0.5 * settings.contact_offset
    scene.touch.apart = SELF_DISTANCE
    scene.air.atmosphere = settings.atmosphere
    scene.air.molar_energy = wp.float64(GAS_CONSTANT * ROOM_TEMPERATURE)
    scene.air.density = AIR_DENSITY
    scene.air.discharge = DISCHARGE
    scene.air.equalise = EQUALISE
    return scene


def _sizes(bodies: Sequence[Body]) -> tuple[list[int], ...]:
    return (
        [len(b.points) for b in bodies],
        [len(b.quads) for b in bodies],
        [len(b.segment_ends) for b in bodies],
        [len(b.rings) for b in bodies],
    )


_VECTORS = {
    "quads": wp.vec4i,
    "corners": wp.vec4i,
    "to_rest": wp.mat22,
    "hourglass": wp.vec4,
    "joint_segment": wp.vec2i,
}


def _dtype(name: str, values: NDArray[Any]) -> Any:
    if name in _VECTORS:
        return _VECTORS[name]
    return {"int32": wp.int32, "float64": wp.float64, "float32": wp.float32}[str(values.dtype)]
