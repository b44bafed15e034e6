"""The substeps of a frame, recorded once as a graph and replayed."""

from __future__ import annotations

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
from balloon_usd.solver.scene import Scene

SEARCH_EVERY = 10
"""Substeps between two searches for facing walls."""
VOLUME_BLOCK = 64
"""Threads that sum one chamber's volume on a GPU."""
GRID_CELLS = 64
"""Cells of the hash grid along each axis."""


class Stepper:
    """Advances a scene by whole frames of a fixed number of substeps."""

    def __init__(self, scene: Scene, substeps: int, reach: float) -> None:
        if substeps % 2:
            raise ValueError(f"the number of substeps must be even, got {substeps}")
        self.scene = scene
        self.substeps = substeps
        self.reach = reach
        """Cell size of the contact search, m."""
        self._grid = wp.HashGrid(GRID_CELLS, GRID_CELLS, GRID_CELLS, device=scene.device)
        self._graphs: dict[bool, wp.Graph] = {}
        self._start()

    def _start(self) -> None:
        """Give rings their middles and chambers their gas before the first substep."""
        s = self.scene
        self._joints(s.x, 1.0)
        self._volumes(s.x)
        volume = s.volume.numpy().astype(float)
        pressure = s.start_gauge.numpy() + s.settings.atmosphere
        amount = pressure * volume / float(s.air.molar_energy)
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
                self._frame(contact)
            finally:
                graph = wp.capture_end(device=device)
            self._graphs[contact] = graph
        wp.capture_launch(self._graphs[contact])

    def stretch(self) -> None:
        """Write the largest principal stretch of every vertex."""
        s = self.scene
        self._launch(vertex_stretch, len(s.x), [s.corners, s.quads, s.to_rest, s.x], [s.stretch])

    def _launch(self, kernel: wp.Kernel, dim: int | tuple[int, ...], inputs: list[object], outputs: list[object]) -> None:
        wp.launch(kernel, dim=dim, inputs=inputs, outputs=outputs, device=self.scene.device)

    def _frame(self, contact: bool) -> None:
        s = self.scene
        here, there = s.x, s.x_next
        for k in range(self.substeps):
            if contact and k % SEARCH_EVERY == 0:
                self._search(here)
            self._substep(here, there, (k + 1) / self.substeps, contact)
            here, there = there, here

    def _substep(self, x: wp.array, x_next: wp.array, fraction: float, contact: bool) -> None:
        s, dt = self.scene, self.scene.settings.dt
        self._volumes(x)
        self._launch(
            balloon_gas,
            len(s.bodies),
            [
                s.balloon_segment,
                s.balloon_segment_end,
                s.end_joint,
                s.inlet,
                s.air,
                dt,
                fraction,
                s.open_from,
                s.open_to,
            ]
            + [s.pump_flow, s.pump_limit, s.pump_goal, s.volume],
            [s.amount, s.pressure],
        )
        if contact:
            self._launch(
                press_walls,
                len(s.x),
                [
                    s.quads,
                    s.mass,
                    s.touch,
                    s.friction,
                    s.vertex_balloon,
                    dt,
                    s.area,
                    s.quad_area,
                    s.target,
                    s.hit_count,
                    x,
                    s.v,
                ],
                [s.slip, s.contact_force, s.contact_share],
            )
        self._launch(
            quad_forces,
            len(s.quads),
            [
                s.quads,
                s.quad_segment,
                s.segment_origin,
                s.quad_law,
                s.to_rest,
                s.hourglass,
                s.rubber_volume,
                s.laws,
            ]
            + [s.pressure, x, s.v, s.peak_energy],
            [s.corner_force],
        )
        if contact:
            self._launch(
                press_back,
                len(s.quads),
                [s.quads, s.hit_count, s.hits, s.contact_force, s.contact_share, x],
                [s.corner_force],
            )
        self._launch(
            move_vertices,
            len(s.x),
            [s.corners, s.vertex_joint, s.vertex_balloon, s.joint_first, s.joint_around, s.joint_segment]
            + [s.segment_origin, s.vertex_along, s.mass, s.weight, s.gravity, s.drag, dt, s.spin, s.target]
            + [s.contact_force, s.corner_force, s.pressure, s.ring_middle, s.ring_area, x],
            [x_next, s.v],
        )
        self._launch(
            load_struts,
            len(s.strut_joint),
            [
                s.strut_joint,
                s.strut_stiffness,
                s.strut_damping,
                s.strut_yield,
                s.ring_middle,
                s.ring_speed,
                s.strut_length,
            ],
            [s.strut_force],
        )
        self._joints(x_next, fraction)
        self._launch(
            hold_welds,
            len(s.weld_size),
            [s.weld_joint, s.weld_size, s.weld_reach, s.weld_gap, s.joint_first, s.joint_around, s.joint_mass]
            + [s.hand, dt, s.ring_middle],
            [x_next, s.v],
        )
        self._launch(
            weld_middles,
            s.weld_joint.shape,
            [s.weld_joint, s.weld_size, s.joint_first, s.joint_around, x_next],
            [s.ring_middle],
        )

    def _joints(self, x: wp.array, fraction: float) -> None:
        s, dt = self.scene, self.scene.settings.dt
        self._launch(
            move_joints,
            len(s.joint_first),
            [
                s.joint_first,
                s.joint_around,
                s.parts,
                s.joint_struts,
                s.joint_mass,
                dt,
                dt * self.substeps,
                fraction,
                s.hand,
            ]
            + [
                s.hand_from,
                s.hand_to,
                s.hand_force,
                s.hand_stiffness,
                s.radius_from,
                s.radius_to,
                s.strut_force,
            ],
            [x, s.v, s.ring_middle, s.ring_area, s.ring_axes, s.ring_speed, s.hand_load],
        )

    def _volumes(self, x: wp.array) -> None:
        s = self.scene
        wp.launch_tiled(
            segment_volumes,
            dim=[len(s.segment_quad)],
            inputs=[s.quads, s.segment_quad, s.segment_quad_end, s.segment_origin, s.start_joint, s.end_joint]
            + [s.ring_middle, s.ring_area, x],
            outputs=[s.volume],
            block_dim=VOLUME_BLOCK,
            device=s.device,
        )

    def _search(self, x: wp.array) -> None:
        """Find the walls that face each other."""
        s = self.scene
        self._launch(quad_surface, len(s.quads), [s.quads, x], [s.quad_middle, s.quad_area])
        self._launch(vertex_surface, len(s.x), [s.corners, s.quad_area], [s.normal, s.area])
        self._launch(ring_radii, len(s.ring_first), [s.ring_first, s.ring_around, x], [s.ring_radius])
        self._grid.build(s.quad_middle, self.reach, groups=s.quad_world)
        s.hit_count.zero_()
        self._launch(
            find_walls,
            len(s.x),
            [self._grid.id, s.quads, s.quad_segment, s.quad_ring, s.quad_along, s.quad_balloon, s.vertex_ring]
            + [s.vertex_along, s.vertex_balloon, s.vertex_segment, s.balloon_world, s.balloon_radius, s.touching, s.touch, x, s.quad_middle]
            + [s.quad_area, s.normal, s.area, s.ring_radius],
            [s.target, s.slip, s.hit_count, s.hits],
        )
        self._launch(order_hits, len(s.quads), [s.hit_count], [s.most_hits, s.hits])
