"""The substeps of a frame in the latex model, recorded once as a graph and replayed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import warp as wp

from balloon_usd.solver.kernels.contact import press_back, press_walls
from balloon_usd.solver.kernels.fingers import press_fingers
from balloon_usd.solver.kernels.gas import balloon_gas, segment_volumes
from balloon_usd.solver.kernels.joints import hold_welds, load_struts, move_joints, shift_middles
from balloon_usd.solver.kernels.lanes import WARP
from balloon_usd.solver.kernels.membrane import quad_forces, vertex_stretch
from balloon_usd.solver.kernels.motion import move_vertices
from balloon_usd.solver.launch import Launcher
from balloon_usd.solver.search_grid import SearchGrid
from balloon_usd.solver.wall_search import WallSearch

if TYPE_CHECKING:
    from balloon_usd.solver.latex.crew import Crew
    from balloon_usd.solver.latex.scene import LatexScene

SEARCH_SECONDS = 1.0 / 120.0
"""Time between two searches for facing walls, s."""


class Stepper:
    """Advances a scene by whole frames of a fixed number of substeps."""

    def __init__(self, scene: LatexScene, substeps: int, reach: float) -> None:
        """Prepare a scene.

        Args:
            scene: state to advance.
            substeps: per frame; even, because positions alternate between two arrays.
            reach: cell size of the contact search (m).

        Raises:
            ValueError: the number of substeps is odd.
        """
        if substeps % 2:
            raise ValueError(f"the number of substeps must be even, got {substeps}")
        self.scene = scene
        self.substeps = substeps
        dt = scene.settings.dt
        values: dict[str, Any] = {"dt": dt, "frame_seconds": dt * substeps, "air": scene.air}
        self._search_every = max(1, round(SEARCH_SECONDS / dt))
        self._launcher = Launcher(scene, values)
        self._launch = self._launcher.launch
        self._grid = SearchGrid(scene, reach, len(scene.quads))
        self._search = WallSearch(self._launcher, self._grid)
        self._crew = _crew_of(scene) if wp.get_device(scene.device).is_cuda else None
        self._start()

    def _start(self) -> None:
        """Give rings their middles and chambers their gas before the first substep."""
        s = self.scene
        self._launch_lanes(move_joints, len(s.joint_first), fraction=1.0)
        self._volumes()
        volume = s.volume.numpy().astype(float)
        amount = (s.start_gauge.numpy() + s.settings.atmosphere) * volume / float(s.air.molar_energy)
        for k, body in enumerate(s.bodies):
            amount[[s.segment_start[k] + i for i in body.vented]] = 0.0
        s.amount.assign(amount)
        s.pressure.assign(s.start_gauge)

    def advance(self, *, contact: bool, fingers: bool = False) -> None:
        """Advance by one frame, with or without walls that can touch and fingers that press."""
        self._grid.claim()
        self._launcher.replay((contact, fingers), lambda: self._frame(contact=contact, fingers=fingers))

    def stretch(self) -> None:
        """Write the largest principal stretch of every vertex."""
        self._launch(vertex_stretch, len(self.scene.x))

    def _frame(self, *, contact: bool, fingers: bool) -> None:
        if self._crew is None:
            self._step_by_step(contact=contact, fingers=fingers)
            return
        stride = self._search_every if contact else self.substeps
        for begin in range(0, self.substeps, stride):
            if contact:
                self._search.sort_quads(self.scene.x)
                self._search.find(self.scene.x)
            end = min(begin + stride, self.substeps)
            self._crew.advance(self._launcher, self.substeps, begin, end, contact=contact, fingers=fingers)

    def _step_by_step(self, *, contact: bool, fingers: bool) -> None:
        """Advance by one frame, one kernel after the other."""
        s = self.scene
        here, there = s.x, s.x_next
        for k in range(self.substeps):
            if contact and k % self._search_every == 0:
                self._search.sort_quads(here)
                self._search.find(here)
            fraction = (k + 1) / self.substeps
            if fingers:
                self._launch(press_fingers, len(s.x), x=here, fraction=fraction)
            self._substep(here, there, fraction, contact=contact)
            here, there = there, here

    def _substep(self, x: Any, x_next: Any, fraction: float, *, contact: bool) -> None:
        s = self.scene
        vertices, quads = len(s.x), len(s.quads)
        self._volumes(x=x)
        self._launch(balloon_gas, len(s.bodies), fraction=fraction)
        if contact:
            self._launch(press_walls, vertices, x=x)
        self._launch(quad_forces, quads, x=x)
        if contact:
            self._launch(press_back, quads, x=x)
        self._launch(move_vertices, vertices, x=x, x_next=x_next)
        self._launch(load_struts, len(s.strut_joint))
        self._launch_lanes(move_joints, len(s.joint_first), x=x_next, fraction=fraction)
        self._launch_lanes(hold_welds, len(s.joint_first), x=x_next)
        self._launch(shift_middles, len(s.joint_first))

    def _launch_lanes(self, kernel: Any, blocks: int, **changing: Any) -> None:
        self._launcher.launch_tiled(kernel, blocks, lanes=WARP, **changing)

    def _volumes(self, **changing: Any) -> None:
        self._launcher.launch_tiled(segment_volumes, len(self.scene.segment_quad), **changing)


def _crew_of(scene: LatexScene) -> Crew:
    # Its large kernel is loaded with the first graph, wherever it is imported.
    from balloon_usd.solver.latex.crew import Crew  # noqa: PLC0415

    return Crew(scene)
