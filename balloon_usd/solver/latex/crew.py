"""The crew: how many blocks of lanes work on each sculpture, and on which part of the flat state.

On the CPU it is one lane for each sculpture.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp

from balloon_usd.solver.kernels.lanes import WARP
from balloon_usd.solver.kernels.sculpture import LANES, advance_sculptures

if TYPE_CHECKING:
    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.launch import Launcher


class Crew:
    """Advances all sculptures of a scene by several substeps in one launch."""

    def __init__(self, scene: LatexScene) -> None:
        """Share out a device; a GPU in as many blocks a sculpture as this fills, and as run at once."""
        self.scene = scene
        worlds = max(scene.worlds) + 1
        body = np.searchsorted(np.asarray(scene.worlds), np.arange(worlds + 1))
        scene.zeros("chunk_share", len(scene.chunk_low), float)
        need = np.zeros(worlds, dtype=int)
        for name, starts in (
            ("balloon", np.arange(len(scene.bodies) + 1)),
            ("quad", scene.quad_start),
            ("vertex", scene.vertex_start),
            ("segment", scene.segment_start),
            ("joint", scene.joint_start),
        ):
            bounds = np.asarray(starts)[body].astype(np.int32)
            scene.put({f"world_{name}": bounds})
            if name in ("vertex", "joint"):
                # Those that look after a ring's joint have no vertices besides.
                need += np.diff(bounds) * (WARP if name == "joint" else 1)
        device = wp.get_device(scene.device)
        self._kernel = _quick_kernel() if device.is_cuda else advance_sculptures
        at_once = device.sm_count // worlds if device.is_cuda else 1
        self.blocks = max(1, min(-(-int(need.max()) // LANES), at_once))
        scene.zeros("gates", worlds, int)

    def advance(
        self, launcher: Launcher, substeps: int, begin: int, end: int, *, contact: bool, fingers: bool
    ) -> None:
        """Advance from one substep of a frame of so many to another."""
        worlds = max(self.scene.worlds) + 1
        self.scene.gates.zero_()
        launcher.launch_tiled(
            self._kernel,
            worlds * self.blocks,
            lanes=LANES,
            crew=self.blocks,
            substeps=substeps,
            begin=begin,
            end=end,
            walls=int(contact),
            pressing=int(fingers),
        )


@cache
def _quick_kernel() -> Any:
    """Return the kernel with approximate divisions and roots: half of the code of exact ones is for numbers
    that cannot occur, and a GPU has to fetch it all in every substep.
    """
    make = wp.kernel(module="unique", module_options={"fast_math": True})
    return make(advance_sculptures.func)
