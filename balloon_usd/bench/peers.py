"""Solvers that do the same task of pinch and turn, and whether they are installed."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, cast

if TYPE_CHECKING:
    from collections.abc import Callable

    from balloon_usd.bench.pinch_task import PinchRun, PinchTask


@dataclass(frozen=True)
class Peer:
    """Another solver."""

    name: str
    title: str
    """Name for people."""
    package: str
    """What is imported."""
    adapter: str
    """Module here that lets it do the task."""
    function: str
    """Function in it."""

    @property
    def installed(self) -> bool:
        """Whether it can be imported."""
        return find_spec(self.package) is not None

    def run(self, task: PinchTask) -> PinchRun:
        """Let it do the task, with its own substeps."""
        adapter = import_module(f"balloon_usd.bench.{self.adapter}")
        do = cast("Callable[[PinchTask], PinchRun]", getattr(adapter, self.function))
        return do(task)


PEERS = {
    peer.name: peer
    for peer in (
        Peer("newton", "Newton XPBD", "newton", "pinch_newton", "run_newton"),
        Peer("blender", "Blender cloth", "bpy", "pinch_blender", "run_blender"),
    )
}
"""All of them by the names of the option."""
HOW_TO_INSTALL = "pip install 'balloon-usd[peers]'"
