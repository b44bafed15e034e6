"""The substeps of a frame in the thesis's model (Kosaka 2008, fig. 3.8), captured once as a graph."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import warp as wp

from balloon_usd.solver.checks import travel_limit
from balloon_usd.solver.kernels.kosaka.air_particles import move_air, repel_air
from balloon_usd.solver.kernels.kosaka.drift import cluster_drift, fastest_air
from balloon_usd.solver.kernels.kosaka.frozen_rings import hold_rings, move_rubber
from balloon_usd.solver.kernels.kosaka.leaked_air import find_leaked_air
from balloon_usd.solver.kernels.kosaka.neighbours import LANES, near_air, near_faces, near_faces_air
from balloon_usd.solver.kernels.kosaka.offset_regions import (
    cluster_pressures,
    face_surface,
    press_air,
    press_faces,
    press_vertices,
)
from balloon_usd.solver.kernels.kosaka.springs import limit_elongation, pull_springs, spring_stretch
from balloon_usd.solver.kernels.kosaka.wall_contact import part_walls
from balloon_usd.solver.kernels.physics.fingers import press_fingers
from balloon_usd.solver.kernels.physics.gas import segment_volumes
from balloon_usd.solver.launch import Launcher
from balloon_usd.solver.search_grid import SearchGrid
from balloon_usd.solver.wall_search import WallSearch

if TYPE_CHECKING:
    from balloon_usd.solver.kosaka.scene import KosakaScene
    from balloon_usd.solver.readback import Readback


MANY_LANES = 256
"""Threads that add up one cluster on a GPU."""


class KosakaStepper:
    """Advances a scene of springs and particles by whole frames of a fixed number of substeps."""

    def __init__(self, scene: KosakaScene, substeps: int, quad_half: float, readback: Readback) -> None:
        """Prepare a scene.

        Args:
            scene: state to advance.
            substeps: per frame.
            quad_half: largest distance of a quad's corner from its middle (m).
            readback: what to copy for frames.
        """
        self.scene = scene
        self.substeps = substeps
        self._readback = readback
        dt = self._dt = scene.settings.dt
        cell = max(b.parameters.re for b in scene.bodies) + scene.margin
        self._grid = SearchGrid(scene, cell, max(len(scene.air), len(scene.quads)))
        values: dict[str, Any] = {
            "dt": dt,
            "frame_seconds": dt * substeps,
            "travel_limit": travel_limit(dt * substeps),
            "substeps": float(substeps),
            "margin": scene.margin,
            "quad_half": quad_half,
            "grid": self._grid.id,
        }
        self._launcher = Launcher(scene, values)
        self._launch = self._launcher.launch
        self._walls = WallSearch(self._launcher)
        self._launcher.load(part_walls, press_fingers)
        self._launch_lanes(hold_rings, len(scene.joint_first), fraction=1.0)
        # No air has leaked yet: this loads the kernel now, not in the middle of a run.
        self.find_leaked()

    def advance(self, *, contact: bool, fingers: bool, searches: int, rings: bool = True) -> None:
        """Advance by one frame.

        `contact`: walls can touch. `fingers`: some press. `searches`: how often neighbours are looked for
        anew; 0 where the lists of the frame before still hold. `rings`: some are held, closing or frozen.
        """
        self._grid.claim()
        self._launcher.replay(
            (contact, fingers, searches, rings),
            lambda: self._frame(contact=contact, fingers=fingers, searches=searches, rings=rings),
        )

    def find_leaked(self) -> None:
        """Bring back air that has leaked beyond every offset region."""
        self._launch_lanes(find_leaked_air, len(self.scene.air))

    def start_readback(self) -> None:
        """Start copying what frames are made of."""
        self._readback.next_buffer()
        self._launcher.replay(("read back", self._readback.buffer), self._read_back)
        self._readback.record()

    def _read_back(self) -> None:
        """Write the stretch of every vertex and the volumes (m3) and pressures (Pa) of all segments, and
        copy.
        """
        segments = len(self.scene.segment_quad)
        self.scene.suspects.zero_()
        self._launch(spring_stretch, len(self.scene.x))
        self._launcher.launch_tiled(segment_volumes, segments, lanes=MANY_LANES)
        self._launcher.launch_tiled(cluster_pressures, segments, lanes=MANY_LANES)
        self.scene.fastest.zero_()
        self._launch(fastest_air, len(self.scene.air))
        self._readback.copy()

    def _frame(self, *, contact: bool, fingers: bool, searches: int, rings: bool) -> None:
        s = self.scene
        s.face_hits.zero_()
        search_every = -(-self.substeps // max(searches, 1))
        for k in range(self.substeps):
            if k % search_every == 0:
                if searches:
                    self._find_neighbours(contact=contact)
                self._launch(cluster_drift, len(s.segment_quad), interval=search_every * self._dt)
            if fingers:
                self._launch(press_fingers, len(s.x), fraction=(k + 1) / self.substeps)
            # The last substep of a frame always measures the rings, for read-back.
            self._substep((k + 1) / self.substeps, contact=contact, rings=rings or k + 1 == self.substeps)
        # Air that leaked in the last substep is put back before read-back.
        self._launch(face_surface, len(s.face_normal))
        self._launch_lanes(press_air, len(s.air))

    def _substep(self, fraction: float, *, contact: bool, rings: bool) -> None:
        """One time step in the order of fig. 3.8."""
        s = self.scene
        vertices, particles = len(s.x), len(s.air)
        if contact:
            # Double buffer: contact writes to `x_next`.
            self._launch(part_walls, vertices)
            wp.copy(s.x, s.x_next)
        with self._launcher.aside():
            self._launch_lanes(repel_air, particles)
            self._launch(pull_springs, vertices)
        self._launch(face_surface, len(s.face_normal))
        self._launch_lanes(press_faces, len(s.quads))
        self._launch(press_vertices, vertices)
        self._launcher.join()
        self._launch_lanes(press_air, particles)
        with self._launcher.aside():
            self._launch(move_air, particles)
        self._launch(move_rubber, vertices, fraction=fraction)
        self._launch(limit_elongation, vertices, x=s.x_next, x_next=s.x)
        if rings:
            self._launch_lanes(hold_rings, len(s.joint_first), fraction=fraction)
        self._launcher.join()

    def _find_neighbours(self, *, contact: bool) -> None:
        """Rebuild the lists of particles, triangles and walls that may touch before the next search."""
        s = self.scene
        self._launch(face_surface, len(s.face_normal))
        self._walls.measure_quads()
        self._grid.build(s.quad_middle, s.quad_world)
        if contact:
            self._walls.find()
        self._launch_lanes(near_faces, len(s.air))
        self._grid.build(s.air, s.air_world)
        self._launch_lanes(near_air, len(s.air))
        self._launch_lanes(near_faces_air, len(s.quads))

    def _launch_lanes(self, kernel: Any, blocks: int, **changing: Any) -> None:
        self._launcher.launch_tiled(kernel, blocks, lanes=LANES, **changing)
