"""The substeps of a frame, recorded once as a graph and replayed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import warp as wp

from balloon_usd.solver.kernels.contact import (
    find_walls,
    order_hits,
    press_back,
    press_walls,
    quad_surface,
    ring_radii,
    vertex_surface,
)
from balloon_usd.solver.kernels.gas import balloon_gas, segment_volumes
from balloon_usd.solver.kernels.joints import hold_welds, load_struts, move_joints, weld_middles
from balloon_usd.solver.kernels.membrane import quad_forces, vertex_stretch
from balloon_usd.solver.kernels.motion import move_vertices

if TYPE_CHECKING:
    from balloon_usd.solver.scene import Scene

SEARCH_EVERY = 10
"""Substeps between two searches for facing walls."""
VOLUME_BLOCK = 64
"""Threads that sum one chamber's volume on a GPU."""
GRID_CELLS = 64
"""Cells of the hash grid along each axis."""


class Stepper:
    """Advances a scene by whole frames of a fixed number of substeps.

    Kernels are launched by the names of their arguments: each name is an array or a value of the scene, or
    one that
    changes from substep to substep.
    """

    def __init__(self, scene: Scene, substeps: int, reach: float) -> None:
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
        self.reach = reach
        self._grid = wp.HashGrid(GRID_CELLS, GRID_CELLS, GRID_CELLS, device=scene.device)
        self._graphs: dict[bool, Any] = {}
        self._values: dict[str, Any] = {
            "dt": scene.settings.dt,
            "frame_seconds": scene.settings.dt * substeps,
            "air": scene.air,
            "touch": scene.touch,
            "grid": self._grid.id,
        }
        self._start()

    def _start(self) -> None:
        """Give rings their middles and chambers their gas before the first substep."""
        s = self.scene
        self._launch(move_joints, len(s.joint_first), fraction=1.0)
        self._volumes()
        volume = s.volume.numpy().astype(float)
        amount = (s.start_gauge.numpy() + s.settings.atmosphere) * volume / float(s.air.molar_energy)
        for k, body in enumerate(s.bodies):
            amount[[s.segment_start[k] + i for i in body.vented]] = 0.0
        s.amount.assign(amount)
        s.pressure.assign(s.start_gauge)

    def advance(self, *, contact: bool) -> None:
        """Advance by one frame, with or without walls that can touch."""
        if contact not in self._graphs:
            device = self.scene.device
            wp.capture_begin(device=device, force_module_load=True)
            try:
                self._frame(contact=contact)
            finally:
                graph = wp.capture_end(device=device)
            self._graphs[contact] = graph
        wp.capture_launch(self._graphs[contact])

    def stretch(self) -> None:
        """Write the largest principal stretch of every vertex."""
        self._launch(vertex_stretch, len(self.scene.x))

    def _launch(self, kernel: Any, dim: int | tuple[int, ...], **changing: Any) -> None:
        values = self._values | changing
        arrays = self.scene.arrays
        inputs = [values[a.label] if a.label in values else arrays[a.label] for a in kernel.adj.args]
        wp.launch(kernel, dim=dim, inputs=inputs, device=self.scene.device)

    def _frame(self, *, contact: bool) -> None:
        s = self.scene
        here, there = s.x, s.x_next
        for k in range(self.substeps):
            if contact and k % SEARCH_EVERY == 0:
                self._search(here)
            self._substep(here, there, (k + 1) / self.substeps, contact=contact)
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
        self._launch(move_joints, len(s.joint_first), x=x_next, fraction=fraction)
        self._launch(hold_welds, len(s.weld_size), x=x_next)
        self._launch(weld_middles, s.weld_joint.shape, x=x_next)

    def _volumes(self, **changing: Any) -> None:
        s = self.scene
        values = s.arrays | changing
        wp.launch_tiled(
            segment_volumes,
            dim=[len(s.segment_quad)],
            inputs=[values[a.label] for a in segment_volumes.adj.args],
            block_dim=VOLUME_BLOCK,
            device=s.device,
        )

    def _search(self, x: Any) -> None:
        """Find the walls that face each other."""
        s = self.scene
        self._launch(quad_surface, len(s.quads), x=x)
        self._launch(vertex_surface, len(s.x))
        self._launch(ring_radii, len(s.ring_first), x=x)
        self._grid.build(s.quad_middle, self.reach, groups=s.quad_world)
        s.hit_count.zero_()
        self._launch(find_walls, len(s.x), x=x)
        self._launch(order_hits, len(s.quads))
