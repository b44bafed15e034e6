"""The substeps of a frame in the latex model, captured once as a graph and replayed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.solver.checks import travel_limit
from balloon_usd.solver.kernels.device.warp_reduce import WARP
from balloon_usd.solver.kernels.physics.gas import segment_volumes
from balloon_usd.solver.kernels.physics.joints import measure_rings
from balloon_usd.solver.kernels.physics.membrane import vertex_stretch
from balloon_usd.solver.kernels.physics.neck_rubber import hide_neck_rubber
from balloon_usd.solver.kernels.physics.wall_load import wall_loads
from balloon_usd.solver.latex.launch_shape import SculptureLaunch
from balloon_usd.solver.latex.untangling import Untangling
from balloon_usd.solver.launch import Launcher
from balloon_usd.solver.wall_search import WallSearch

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.readback import Readback

SEARCH_SECONDS = 1.0 / 120.0
"""Time between two searches for facing walls, s."""

CHUNKS_PER_THREAD = 8
"""Least chunks of quads of a sculpture for each thread of a CPU: with less work barriers take most of it."""


class Stepper:
    """Advances a scene by whole frames of a fixed number of substeps."""

    def __init__(self, scene: LatexScene, substeps: int, threads: int = 1) -> None:
        """Prepare a scene; `substeps`: per frame, `threads`: of a CPU that may share the work."""
        self.scene = scene
        self.substeps = substeps
        dt = scene.settings.dt
        values: dict[str, Any] = {"dt": dt, "frame_seconds": dt * substeps, "air": scene.air}
        values["travel_limit"] = travel_limit(dt * substeps)
        self._search_every = max(1, round(SEARCH_SECONDS / dt))
        scene.touch.ahead = self._search_every * dt
        busy = len(scene.chunk_low) // (CHUNKS_PER_THREAD * (max(scene.worlds) + 1))
        self._launcher = Launcher(scene, values, max(1, min(threads, busy)))
        self._launch = self._launcher.launch
        self._search = WallSearch(self._launcher)
        self._untangling = Untangling(self._launcher, scene.touch.ahead)
        self._launcher.load(wall_loads, lanes=WARP)
        self._sculptures = SculptureLaunch(scene)
        self._start()

    def _start(self) -> None:
        """Give rings their middles and chambers their gas before the first substep."""
        s = self.scene
        self._launch(hide_neck_rubber, len(s.quads))
        self._launcher.launch_tiled(measure_rings, len(s.joint_first), lanes=WARP)
        self._volumes()
        host = s.host_segment.numpy()
        volume = s.volume.numpy().astype(float)
        np.subtract.at(volume, host[host >= 0], volume[host >= 0])
        s.volume.assign(volume)
        gauge = np.concatenate([b.gauge for b in s.bodies]).astype(np.float32)
        amount = (gauge + s.settings.atmosphere) * volume / float(s.air.molar_energy)
        for k, body in enumerate(s.bodies):
            amount[[s.segment_start[k] + i for i in body.vented]] = 0.0
        s.amount.assign(amount)
        s.pressure.assign(gauge)

    def advance(self, *, contact: bool, fingers: bool = False) -> None:
        """Advance by one frame, with or without walls that can touch and fingers that press."""
        self._launcher.replay_together(
            (contact, fingers), lambda: self._frame(contact=contact, fingers=fingers)
        )

    def leave(self, over: NDArray[np.bool_]) -> None:
        """Leave sculptures as they are that are over, (sculptures,)."""
        self._sculptures.leave(over)

    def start_readback(self, readback: Readback, *, contact: bool) -> None:
        """Start copying what frames are made of; where walls can touch, with the loads on them."""
        readback.next_buffer()
        self._launcher.replay(
            ("read back", readback.buffer, contact), lambda: self._read_back(readback, contact=contact)
        )
        readback.record()

    def _read_back(self, readback: Readback, *, contact: bool) -> None:
        """Write the largest principal stretch of every vertex and the force with which other walls press on
        every segment, and copy.
        """
        self.scene.suspects.zero_()
        self._launch(vertex_stretch, len(self.scene.x))
        if contact:
            self._launcher.launch_tiled(wall_loads, len(self.scene.segment_quad), lanes=WARP)
        readback.copy()

    def _frame(self, *, contact: bool, fingers: bool) -> None:
        stride = self._search_every if contact else self.substeps
        self._untangling.begin_frame()
        self._launch(hide_neck_rubber, len(self.scene.quads))
        for begin in range(0, self.substeps, stride):
            if contact:
                self._search.measure_quads()
                self._search.find()
            end = min(begin + stride, self.substeps)
            self._sculptures.advance(
                self._launcher, self.substeps, begin, end, contact=contact, fingers=fingers
            )
            if contact and end < self.substeps:
                self._untangling.watch()
        if contact:
            self._untangling.end_frame()
        else:
            self._untangling.leave()

    def _volumes(self) -> None:
        self._launcher.launch_tiled(segment_volumes, len(self.scene.segment_quad))
