"""The flat state: all balloons of all sculptures in one set of device arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import warp as wp

from balloon_usd.balloon.rubber import Rubber
from balloon_usd.solver.body import Body
from balloon_usd.solver.kernels.contact import HITS, TARGETS, Touch
from balloon_usd.solver.kernels.gas import Air
from balloon_usd.solver.kernels.joints import Axes
from balloon_usd.solver.kernels.motion import Spin
from balloon_usd.solver.kernels.rubber import Law
from balloon_usd.solver.membrane_data import MembraneData, membrane_data, step_viscosity

GAS_CONSTANT = 8.314462618
"""J/(mol K)."""
TEMPERATURE = 293.15
"""Room temperature, K; the gas stays isothermal (physics.md 2.2: thin walls, slow moves)."""
MEMBRANE_DAMPING = 0.35
"""Damping of the fastest mesh mode, share of critical."""
AIR_DENSITY = 1.29
"""Air at room temperature and 7 kPa gauge, kg/m3."""
DISCHARGE = 0.6
"""Discharge coefficient of a sharp orifice."""
EQUALISE = 0.25
"""Largest share of a pressure difference that may even out in one substep: keeps the flow stable."""
STRUT_SLOTS = 24
"""Struts that may end at one joint."""
WELD_SLOTS = 16
"""Joints that one weld may hold together."""


@dataclass(frozen=True)
class SceneSettings:
    """Settings shared by everything in a scene."""

    dt: float
    """Time step, s."""
    atmosphere: float = 101325.0
    """Ambient pressure, Pa."""
    drag: float = 5.0
    """Air drag as a rate, 1/s."""
    gravity: float = 0.0
    """Gravity towards -z, m/s2."""
    friction: float = 0.8
    """Coulomb coefficient of rubber on rubber."""
    scale_mass: bool = True
    """Whether masses are raised until the time step is stable."""
    contact_offset: float = 1.5e-3
    """Distance at which walls begin to press, m."""
    contact_pressure: float = 1.0e4
    """Pressure that each of two walls adds at zero distance, Pa: together above any pressure inside."""


@dataclass
class Scene:
    """Bodies flattened into arrays on one device; indices are global over all bodies."""

    bodies: tuple[Body, ...]
    worlds: tuple[int, ...]
    settings: SceneSettings
    device: str
    vertex_start: np.ndarray
    """First vertex of every body, (B + 1,)."""
    quad_start: np.ndarray
    segment_start: np.ndarray
    joint_start: np.ndarray
    arrays: dict[str, wp.array] = field(default_factory=dict)
    air: Air = field(default_factory=Air)
    touch: Touch = field(default_factory=Touch)
    reach: float = 0.0
    """Largest distance at which a contact search looks, m."""

    def __getattr__(self, name: str) -> wp.array:
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

    `worlds`: sculpture of every body; bodies of different sculptures never touch. `weld_count`, `strut_count`: room for
    welds and struts.
    """
    starts = [np.concatenate([[0], np.cumsum(sizes)]) for sizes in _sizes(bodies)]
    scene = Scene(tuple(bodies), tuple(worlds), settings, device, *starts)
    data = [
        membrane_data(b, settings.dt, settings.atmosphere, scale_mass=settings.scale_mass) for b in bodies
    ]
    host: dict[str, np.ndarray] = {}
    _mesh_arrays(scene, data, host)
    _ring_arrays(scene, data, host)
    _gas_arrays(scene, host)
    for name, values in host.items():
        scene.arrays[name] = wp.array(values, dtype=_dtype(name, values), device=device)
    _state_arrays(scene, weld_count, strut_count)
    scene.touch.offset = settings.contact_offset
    scene.touch.pressure = settings.contact_pressure
    scene.touch.margin = 0.5 * settings.contact_offset
    scene.touch.apart = 1.0
    scene.air.atmosphere = settings.atmosphere
    scene.air.molar_energy = GAS_CONSTANT * TEMPERATURE
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


def _dtype(name: str, values: np.ndarray) -> type:
    if name in _VECTORS:
        return _VECTORS[name]
    return {"int32": wp.int32, "float64": wp.float64, "float32": wp.float32}[str(values.dtype)]


def _mesh_arrays(scene: Scene, data: list[MembraneData], host: dict[str, np.ndarray]) -> None:
    """Topology and material of quads and vertices."""
    bodies = scene.bodies
    index = np.arange(len(bodies), dtype=np.int32)
    v, q, s = scene.vertex_start, scene.quad_start, scene.segment_start
    host["quads"] = np.concatenate([b.quads + v[k] for k, b in enumerate(bodies)]).astype(np.int32)
    host["corners"] = np.concatenate(
        [np.where(d.corners >= 0, d.corners + 4 * q[k], -1) for k, d in enumerate(data)]
    ).astype(np.int32)
    host["to_rest"] = np.concatenate([d.to_rest for d in data]).astype(np.float32)
    host["hourglass"] = np.concatenate([d.hourglass for d in data]).astype(np.float32)
    host["rubber_volume"] = np.concatenate([d.rubber_volume for d in data]).astype(np.float32)
    host["mass"] = np.concatenate([d.mass for d in data]).astype(np.float32)
    host["weight"] = np.concatenate([d.true_mass for d in data]).astype(np.float32)
    segments = [np.searchsorted(b.segment_ends, np.arange(len(b.quads)), side="right") for b in bodies]
    host["quad_segment"] = np.concatenate([g + s[k] for k, g in enumerate(segments)]).astype(np.int32)
    host["quad_law"] = np.repeat(index, np.diff(q)).astype(np.int32)
    host["quad_balloon"], host["vertex_balloon"] = (
        host["quad_law"],
        np.repeat(index, np.diff(v)).astype(np.int32),
    )
    host["vertex_along"] = np.concatenate([b.along for b in bodies]).astype(np.float32)
    host["quad_along"] = np.concatenate([b.along[b.quads].mean(axis=1) for b in bodies]).astype(np.float32)
    host["balloon_world"] = np.asarray(scene.worlds, dtype=np.int32)
    host["vertex_world"] = host["balloon_world"][host["vertex_balloon"]]
    host["quad_world"] = host["balloon_world"][host["quad_balloon"]]
    host["balloon_radius"] = np.array([b.radius for b in bodies], dtype=np.float32)
    for name, value in (
        ("gravity", scene.settings.gravity),
        ("drag", scene.settings.drag),
        ("friction", scene.settings.friction),
    ):
        host[name] = np.full(len(bodies), value, dtype=np.float32)


def _ring_arrays(scene: Scene, data: list[MembraneData], host: dict[str, np.ndarray]) -> None:
    """Rings of the mesh, and the rings that can be held or closed ("joints")."""
    bodies, v = scene.bodies, scene.vertex_start
    ring_start = np.concatenate([[0], np.cumsum([len(b.mesh_rings) for b in bodies])])
    host["ring_first"] = np.array(
        [f + v[k] for k, b in enumerate(bodies) for f, _ in b.mesh_rings], dtype=np.int32
    )
    host["ring_around"] = np.array([n for b in bodies for _, n in b.mesh_rings], dtype=np.int32)
    host["vertex_ring"] = np.concatenate(
        [b.vertex_ring + ring_start[k] for k, b in enumerate(bodies)]
    ).astype(np.int32)
    host["quad_ring"] = np.concatenate(
        [b.vertex_ring[b.quads[:, 0]] + ring_start[k] for k, b in enumerate(bodies)]
    ).astype(np.int32)
    first = [r.first + v[k] for k, b in enumerate(bodies) for r in b.rings]
    around = [r.around for b in bodies for r in b.rings]
    # A scene without rings still needs arrays to launch over; an empty ring does nothing.
    host["joint_first"] = np.array(first or [0], dtype=np.int32)
    host["joint_around"] = np.array(around or [1], dtype=np.int32)
    host["parts"] = np.array([r.parts for b in bodies for r in b.rings] or [False], dtype=np.int32)
    vertex_joint = np.full(v[-1], -1, dtype=np.int32)
    for j, (f, n) in enumerate(zip(first, around, strict=True)):
        vertex_joint[f : f + n] = j
    host["vertex_joint"] = vertex_joint
    home = np.full(v[-1], -1, dtype=np.int32)
    home[host["quads"].reshape(-1)] = np.repeat(host["quad_segment"], 4)
    parting = (vertex_joint >= 0) & (host["parts"][vertex_joint] == 1)
    host["vertex_segment"] = np.where(parting, -1, home).astype(np.int32)
    mass = np.concatenate([d.mass for d in data])
    host["joint_mass"] = np.array(
        [mass[f : f + n].sum() for f, n in zip(first, around, strict=True)] or [1.0], dtype=np.float32
    )


def _gas_arrays(scene: Scene, host: dict[str, np.ndarray]) -> None:
    """Chambers: runs of quads between the rings that part them."""
    quad, quad_end, origin, start_joint, end_joint, gauge = [], [], [], [], [], []
    sides = np.full((max(1, int(scene.joint_start[-1])), 2), -1, dtype=np.int32)
    for k, b in enumerate(scene.bodies):
        parting = [scene.joint_start[k] + i for i, r in enumerate(b.rings) if r.parts]
        if len(parting) != len(b.segment_ends) - 1:
            raise ValueError("every border between two chambers needs its ring")
        begin = 0
        for i, end in enumerate(b.segment_ends):
            quad.append(begin + scene.quad_start[k])
            quad_end.append(end + scene.quad_start[k])
            origin.append(b.quads[begin, 0] + scene.vertex_start[k])
            start_joint.append(parting[i - 1] if i > 0 else -1)
            end_joint.append(parting[i] if i < len(parting) else -1)
            gauge.append(b.gauge[i])
            if i > 0:
                sides[parting[i - 1], 1] = len(quad) - 1
            if i < len(parting):
                sides[parting[i], 0] = len(quad) - 1
            begin = end
    host["segment_quad"], host["segment_quad_end"] = np.array(quad, np.int32), np.array(quad_end, np.int32)
    host["segment_origin"] = np.array(origin, np.int32)
    host["start_joint"], host["end_joint"] = np.array(start_joint, np.int32), np.array(end_joint, np.int32)
    host["joint_segment"] = sides
    host["balloon_segment"] = scene.segment_start[:-1].astype(np.int32)
    host["balloon_segment_end"] = scene.segment_start[1:].astype(np.int32)
    host["inlet"] = (scene.segment_start[:-1] + [b.inlet for b in scene.bodies]).astype(np.int32)
    host["start_gauge"] = np.array(gauge, np.float32)


def _state_arrays(scene: Scene, weld_count: int, strut_count: int) -> None:
    """State and scratch arrays, at rest."""
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
        ("peak_energy", quads),
        ("area", vertices),
        ("ring_radius", len(a["ring_first"])),
        ("stretch", vertices),
    ):
        zeros(name, count, float)
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
    zeros("most_hits", 1, int)
    for name in ("ring_middle", "ring_area", "ring_speed", "hand_load", "hand_from", "hand_to"):
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


def device_law(rubber: Rubber, dt: float) -> Law:
    """Return a rubber as the kernels take it.

    Raises:
        ValueError: the rubber has more than three Ogden terms.
    """
    if len(rubber.mu) > 3:
        raise ValueError(f"rubber {rubber.name}: at most three Ogden terms, got {len(rubber.mu)}")
    law = Law()
    law.mu = wp.vec3(*rubber.mu, *[0.0] * (3 - len(rubber.mu)))
    law.alpha = wp.vec3(*rubber.alpha, *[1.0] * (3 - len(rubber.mu)))
    law.mu_per_alpha = wp.vec3(*[m / k for m, k in zip(law.mu, law.alpha, strict=True)])
    law.gent_mu, law.gent_limit = rubber.gent_mu, min(rubber.gent_limit, 1e9)
    if rubber.softening is not None:
        law.soft_depth, law.soft_width = 1.0 / rubber.softening.r, rubber.softening.c
    law.log_limit = float(np.log(STRETCH_LIMIT))
    law.viscosity = step_viscosity(rubber, dt, MEMBRANE_DAMPING)
    law.hourglass_damping = MEMBRANE_DAMPING * dt
    return law


STRETCH_LIMIT = 9.0
"""Stretch up to which rubber laws are followed: beyond burst (7 to 7.5) they only need to stay finite."""
