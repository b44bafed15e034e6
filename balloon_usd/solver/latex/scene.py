"""The flat state of the latex model: walls of rubber and chambers of gas added to the meshes."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import warp as wp

from balloon_usd.balloon.air import AIR_DENSITY, GAS_CONSTANT, ROOM_TEMPERATURE
from balloon_usd.solver.kernels.arrays.latex import Chambers, Cores, Crossings, Forces, Rubber, Struts
from balloon_usd.solver.kernels.arrays.rows import SPINS, STRUT_SLOTS, Air, Law
from balloon_usd.solver.latex.cores import core_arrays
from balloon_usd.solver.latex.device_law import device_laws
from balloon_usd.solver.latex.hidden_rubber import HiddenRubber
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


@dataclass
class LatexScene(Scene):
    """Balloons of the latex model on one device."""

    bodies: tuple[LatexBody, ...]
    air: Air = field(default_factory=Air)

    @cached_property
    def hidden_rubber(self) -> HiddenRubber:
        """What closed necks hide."""
        return HiddenRubber(self.bodies, self.start_joint.numpy(), self.end_joint.numpy())


def build_scene(
    bodies: Sequence[LatexBody],
    worlds: Sequence[int],
    settings: SceneSettings,
    device: str,
    weld_count: int,
    strut_count: int,
    strut_slots: int = STRUT_SLOTS,
    part_count: int = 0,
) -> LatexScene:
    """Put bodies on a device.

    `worlds`: sculpture of every body; bodies of different sculptures never touch. `weld_count`,
    `strut_count`: capacity for welds and struts; `strut_slots`: for struts that end at one joint;
    `part_count`: for parts that turn against each other when hands let go.
    """
    scene = LatexScene.of(bodies, worlds, settings, device)
    scene.arrays.set_size("spins", SPINS * (max(worlds) + 1) + part_count)
    data = [
        membrane_data(b, settings.dt, settings.atmosphere, scale_mass=settings.scale_mass) for b in bodies
    ]
    host: Arrays = {
        name: np.concatenate([getattr(d, name) for d in data]).astype(np.float32)
        for name in ("rest_inverse", "hourglass", "rubber_volume", "mass", "true_mass")
    }
    lay_meshes(scene, host, weld_count)
    rings = [ring.closed for body in bodies for ring in body.rings]
    # Device arrays are never empty: a scene without joints gets one that closes nothing.
    closed = np.array(rings or [True], dtype=np.float32)
    scene.arrays.put(
        _gas_arrays(scene)
        | core_arrays(scene.bodies, scene.by_world)
        | {
            "quad_law": scene.quad_balloon.numpy(),
            "rest_length": scene.hidden_rubber.rest_length(closed, np.zeros_like(closed)),
            "quad_length": np.ones(len(scene.quads), dtype=np.float32),
            "peak_energy": np.concatenate([b.worked for b in scene.bodies]).astype(np.float32),
        }
    )
    _law_arrays(scene)
    scene.arrays.fill("softening_rate", 1.0)
    scene.arrays.set_size("struts", max(1, strut_count))
    scene.arrays.set_size("slots for struts", strut_slots)
    scene.arrays.fill("strut_joint", wp.vec2i(-1, -1))
    packs = any(b.packs for b in scene.bodies)
    scene.arrays.set_size("packed vertices", int(scene.vertex_start[-1]) if packs else 1)
    scene.arrays.zero_others(Chambers, Cores, Crossings, Forces, Rubber, Struts)
    scene.air.atmosphere = settings.atmosphere
    scene.air.molar_energy = wp.float64(GAS_CONSTANT * ROOM_TEMPERATURE)
    scene.air.density = AIR_DENSITY
    scene.air.discharge = DISCHARGE
    scene.air.equalise = EQUALISE
    return scene


def _gas_arrays(scene: LatexScene) -> Arrays:
    """Chambers of every balloon, each one segment, and its inlet."""
    segments = np.arange(int(scene.segment_start[-1]), dtype=np.int32)
    return (
        {
            "balloon_segment": scene.segment_start[:-1].astype(np.int32),
            "balloon_segment_end": scene.segment_start[1:].astype(np.int32),
            "inlet": (scene.segment_start[:-1] + [b.inlet for b in scene.bodies]).astype(np.int32),
            "chamber_first": segments,
            "chamber_last": segments,
        }
        | _guest_arrays(scene)
        | _flow_arrays(scene)
    )


def _guest_arrays(scene: LatexScene) -> Arrays:
    """Segments that lie in others: the one in which each does, and those that lie in each."""
    inside = np.full(len(scene.bodies), -1, dtype=np.int32)
    for k, (body, host_body) in enumerate(zip(scene.bodies, scene.hosts, strict=True)):
        if body.inside is not None:
            inside[k] = scene.bubbles_of(int(host_body))[body.inside[1]]
    host = np.repeat(inside, np.diff(scene.segment_start))
    guests = np.flatnonzero(host >= 0)
    guests = guests[np.argsort(host[guests], kind="stable")].astype(np.int32)
    return {
        "host_segment": host,
        "first_guest": np.searchsorted(host[guests], np.arange(len(host) + 1)).astype(np.int32),
        # Device arrays are never empty.
        "guests": guests if len(guests) else np.zeros(1, dtype=np.int32),
    }


def _flow_arrays(scene: LatexScene) -> Arrays:
    """Edges of every balloon, along which gas can flow: from each segment to the next; nothing flows yet."""
    end_joint = scene.end_joint.numpy()
    source = np.flatnonzero(end_joint >= 0).astype(np.int32)
    # Device arrays are never empty: a scene without edges gets one that does nothing.
    some = source if len(source) else np.zeros(1, dtype=np.int32)
    return {
        "balloon_edge": np.searchsorted(source, scene.segment_start).astype(np.int32),
        "flow_from": some,
        "flow_to": some + np.int32(len(source) > 0),
        "flow_joint": np.maximum(end_joint[some], 0),
        "chamber_end": np.zeros(len(end_joint) + 1, dtype=np.int32),
        "flow_ends": np.zeros(2 * len(some), dtype=np.int32),
    }


def _law_arrays(scene: LatexScene) -> None:
    """Put the rubbers of all balloons and the curves of their laws on the device."""
    laws, curves = device_laws([b.rubber for b in scene.bodies], scene.settings.dt)
    scene.arrays.put({"curves": curves})
    scene.arrays["laws"] = wp.array(laws, dtype=Law, device=scene.device)
