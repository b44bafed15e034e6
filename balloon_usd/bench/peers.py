"""Solvers that do the same tasks, and whether they are installed."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, cast

if TYPE_CHECKING:
    from collections.abc import Callable

    from balloon_usd.bench.crowd_task import CrowdRun, CrowdTask
    from balloon_usd.bench.pinch_task import PinchRun, PinchTask


@dataclass(frozen=True)
class Peer:
    """Another solver."""

    name: str
    """Of the option; modules and functions here that let it do a task are called after it."""
    title: str
    """Name for people of what pinches and turns a tube."""
    crowd_title: str
    """The same of what turns a crowd of tubes."""
    package: str
    """What is imported."""

    @property
    def installed(self) -> bool:
        """Whether it can be imported."""
        return find_spec(self.package) is not None

    def pinch(self, task: PinchTask) -> PinchRun:
        """Let it pinch and turn a tube, with its own substeps."""
        return cast("Callable[[PinchTask], PinchRun]", self._adapter("pinch"))(task)

    def crowd(self, task: CrowdTask) -> CrowdRun:
        """Let it turn a crowd of tubes, with its own substeps."""
        return cast("Callable[[CrowdTask], CrowdRun]", self._adapter("crowd"))(task)

    def _adapter(self, task: str) -> object:
        module = import_module(f"balloon_usd.bench.{task}_{self.name}")
        return getattr(module, f"run_{self.name}")


PEERS = {
    peer.name: peer
    for peer in (
        Peer("newton", "Newton XPBD", "Newton VBD", "newton"),
        Peer("blender", "Blender cloth", "Blender cloth", "bpy"),
    )
}
"""All of them by the names of the option."""
HOW_TO_INSTALL = "pip install 'balloon-usd[peers]'"
