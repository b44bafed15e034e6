"""The substeps of a frame in the thesis's model (Kosaka 2008, fig. 3.8), recorded once as a graph."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.solver.kernels.drift import cluster_drift
from balloon_usd.solver.kernels.fingers import press_fingers
from balloon_usd.solver.kernels.frozen import hold_rings, move_rubber
from balloon_usd.solver.kernels.gas import segment_volumes
from balloon_usd.solver.kernels.near import near_air, near_faces, order_air
from balloon_usd.solver.kernels.offsets import (
    face_surface,
    find_lost_air,
    press_air,
    press_faces,
    press_vertices,
)
from balloon_usd.solver.kernels.particles import move_air, repel_air
from balloon_usd.solver.kernels.springs import limit_elongation, pull_springs, spring_stretch
from balloon_usd.solver.kernels.walls import part_walls
from balloon_usd.solver.kosaka.parameters import SEARCH_EVERY
from balloon_usd.solver.launch import Launcher
from balloon_usd.solver.wall_search import WallSearch, hash_grid

if TYPE_CHECKING:
    from balloon_usd.solver.kosaka.scene import KosakaScene


class KosakaStepper:
    """Advances a scene of springs and particles by whole frames of a fixed number of substeps."""

    def __init__(self, scene: KosakaScene, substeps: int, reach: float, quad_half: float) -> None:
        """Prepare a scene.

        Args:
            scene: state to advance.
            substeps: per frame.
            reach: cell size of the searches among quads (m).
            quad_half: largest distance of a quad's corner from its middle (m).
        """
        self.scene = scene
        self.substeps = substeps
        dt = scene.settings.dt
        self._air_grid = hash_grid(scene.device)
        self._cell = max(b.parameters.re for b in scene.bodies) + scene.margin
        values: dict[str, Any] = {
            "dt": dt,
            "frame_seconds": dt * substeps,
            "margin": scene.margin,
            "quad_half": quad_half,
            "air_grid": self._air_grid.id,
        }
        self._launcher = Launcher(scene, values)
        self._launch = self._launcher.launch
        self._walls = WallSearch(self._launcher, reach)
        self._launch(hold_rings, len(scene.joint_first), fraction=1.0)

    def advance(self, *, contact: bool, fingers: bool = False) -> None:
        """Advance by one frame, with or without walls that can touch and fingers that press."""
        self._launcher.replay((contact, fingers), lambda: self._frame(contact=contact, fingers=fingers))

    def find_lost(self) -> None:
        """Bring back air that has leaked beyond every offset region."""
        self._launch(find_lost_air, len(self.scene.air))

    def look(self) -> None:
        """Write the stretch of every vertex and the volume (m3) of every segment."""
        self._launch(spring_stretch, len(self.scene.x))
        self._launcher.launch_tiled(segment_volumes, len(self.scene.segment_quad))

    def _frame(self, *, contact: bool, fingers: bool) -> None:
        s = self.scene
        s.face_hits.zero_()
        for k in range(self.substeps):
            if k % SEARCH_EVERY == 0:
                if contact:
                    self._walls.find(s.x)
                self._find_neighbours()
                self._launcher.launch_tiled(cluster_drift, len(s.segment_quad))
            if fingers:
                self._launch(press_fingers, len(s.x), fraction=(k + 1) / self.substeps)
            self._substep((k + 1) / self.substeps)

    def _substep(self, fraction: float) -> None:
        """One time step in the order of fig. 3.8; the wall stands in `x_next` until its lengths are limited."""
        s = self.scene
        vertices, faces, particles = len(s.x), len(s.face_normal), len(s.air)
        wall = s.x_next
        self._launch(part_walls, vertices)
        self._launch(face_surface, faces, x=wall)
        self._launch(repel_air, particles)
        self._launch(press_faces, faces, x=wall)
        self._launch(press_vertices, vertices)
        self._launch(press_air, particles, x=wall)
        self._launch(pull_springs, vertices, x=wall)
        self._launch(move_air, particles)
        self._launch(move_rubber, vertices, x=wall, fraction=fraction)
        self._launch(limit_elongation, vertices, x=wall, x_next=s.x)
        self._launch(hold_rings, len(s.joint_first), fraction=fraction)

    def _find_neighbours(self) -> None:
        """List the particles and triangles that may meet before the next search."""
        s = self.scene
        self._launch(face_surface, len(s.face_normal))
        self._air_grid.build(s.air, self._cell, groups=s.air_world)
        self._launch(near_air, len(s.air))
        self._walls.sort_quads(s.x)
        s.face_air_count.zero_()
        self._launch(near_faces, len(s.air))
        self._launch(order_air, len(s.face_normal))
