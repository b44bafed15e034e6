"""The flat state of the latex model: walls of rubber and chambers of gas added to the meshes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import warp as wp

from balloon_usd.balloon.air import AIR_DENSITY, GAS_CONSTANT, ROOM_TEMPERATURE
from balloon_usd.solver.kernels.physics.gas import Air
from balloon_usd.solver.kernels.physics.joints import Axes
from balloon_usd.solver.kernels.physics.motion import Spin
from balloon_usd.solver.kernels.physics.rubber import CurveSegment, Law
from balloon_usd.solver.latex.cores import core_arrays
from balloon_usd.solver.latex.device_law import device_laws
from balloon_usd.solver.latex.membrane_data import membrane_data
from balloon_usd.solver.scene import Scene, lay_meshes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.solver.flatten import Arrays
    from balloon_usd.solver.latex.body import LatexBody
    from balloon_usd.solver.settings import SceneSettings

DISCHARGE = 0.6
"""Discharge coefficient of a sharp orifice."""
EQUALISE = 0.9
"""Largest share of a pressure difference that may even out in one substep, between rigid walls: stable."""
STRUT_SLOTS = 24
"""Most struts that may end at one joint."""


@dataclass
class LatexScene(Scene):
    """Balloons of the latex model on one device."""

    bodies: tuple[LatexBody, ...]
    air: Air = field(default_factory=Air)


def build_scene(
    bodies: Sequence[LatexBody],
    worlds: Sequence[int],
    settings: SceneSettings,
    device: str,
    weld_count: int,
    strut_count: int,
) -> LatexScene:
    """Put bodies on a device.

    `worlds`: sculpture of every body; bodies of different sculptures never touch. `weld_count`,
    `strut_count`: capacity for welds and struts.
    """
    scene = LatexScene.of(bodies, worlds, settings, device)
    data = [
        membrane_data(b, settings.dt, settings.atmosphere, scale_mass=settings.scale_mass) for b in bodies
    ]
    host: Arrays = {
        name: np.concatenate([getattr(d, name) for d in data]).astype(np.float32)
        for name in ("rest_inverse", "hourglass", "rubber_volume", "mass", "true_mass")
    }
    lay_meshes(scene, host, weld_count)
    host = {"quad_law": scene.quad_balloon.numpy()}
    _gas_arrays(scene, host)
    scene.put(host)
    _core_arrays(scene)
    _state_arrays(scene, strut_count)
    scene.air.atmosphere = settings.atmosphere
    scene.air.molar_energy = wp.float64(GAS_CONSTANT * ROOM_TEMPERATURE)
    scene.air.density = AIR_DENSITY
    scene.air.discharge = DISCHARGE
    scene.air.equalise = EQUALISE
    return scene


def _gas_arrays(scene: LatexScene, host: Arrays) -> None:
    """Chambers of every balloon, its inlet, and the pressures at the start."""
    host["balloon_segment"] = scene.segment_start[:-1].astype(np.int32)
    host["balloon_segment_end"] = scene.segment_start[1:].astype(np.int32)
    host["inlet"] = (scene.segment_start[:-1] + [b.inlet for b in scene.bodies]).astype(np.int32)
    host["start_gauge"] = np.concatenate([b.gauge for b in scene.bodies]).astype(np.float32)


def _core_arrays(scene: LatexScene) -> None:
    """Cores of the balloons that pack, and the forces of these."""
    scene.put(core_arrays(scene.bodies, scene.by_world))
    pushed = int(scene.vertex_start[-1]) if any(b.packs for b in scene.bodies) else 1
    for name in ("core_order", "core_push"):
        scene.zeros(name, pushed, wp.vec3)
    scene.zeros("core_thrust", len(scene.core_ring), wp.vec3)


def _state_arrays(scene: LatexScene, strut_count: int) -> None:
    """Make the state and scratch arrays of walls, gas, joints and struts, at rest."""
    a = scene.arrays
    quads, segments = int(scene.quad_start[-1]), int(scene.segment_start[-1])
    joints, balloons = len(a["joint_first"]), len(scene.bodies)
    worked = np.concatenate([b.worked for b in scene.bodies]).astype(np.float32)
    a["peak_energy"] = wp.array(worked, dtype=float, device=scene.device)
    a["softening_rate"] = wp.full(balloons, 1.0, dtype=float, device=scene.device)
    scene.zeros("pressure", segments, float)
    scene.zeros("chamber_volume", segments, float)
    scene.zeros("wall_load", segments, float)
    for name in ("amount", "flow"):
        scene.zeros(name, segments, wp.float64)
    scene.zeros("pair_corners", len(a["pairs"]), wp.vec4i)
    scene.zeros("pair_limits", len(a["pairs"]), wp.vec4)
    scene.zeros("corner_force", (4 * 3, quads), float)
    scene.zeros("volume_gradient", (4 * 3, quads), float)
    for name in ("chamber_first", "chamber_last"):
        a[name] = wp.array(np.arange(segments), dtype=int, device=scene.device)
    for name in ("open_from", "open_to"):
        scene.zeros(name, joints, float)
    scene.zeros("ring_axes", joints, Axes)
    scene.zeros("joint_struts", (joints, STRUT_SLOTS), int)
    scene.zeros("spin", balloons, Spin)
    scene.zeros("blowing", balloons, int)
    scene.zeros("pump_flow", balloons, float)
    scene.zeros("pump_limit", balloons, float)
    scene.zeros("pump_goal", balloons, wp.float64)
    struts = max(1, strut_count)
    a["strut_joint"] = wp.full(struts, wp.vec2i(-1, -1), dtype=wp.vec2i, device=scene.device)
    for name in ("strut_stiffness", "strut_damping", "strut_yield", "strut_length"):
        scene.zeros(name, struts, float)
    scene.zeros("strut_force", struts, wp.vec3)
    laws, curves = device_laws([b.rubber for b in scene.bodies], scene.settings.dt)
    a["laws"] = wp.array(laws, dtype=Law, device=scene.device)
    a["curves"] = wp.array(curves, dtype=CurveSegment, device=scene.device)
