"""What stands at the head of a layer: units, up axis, rates, range and provenance."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.stage.provenance import KEY

if TYPE_CHECKING:
    from collections.abc import Mapping


def set_units(layer: Any, root: str) -> None:
    """Metres, kilograms, Z up, and the default prim.

    Authored in every layer, since each one may be opened by itself.
    """
    layer.defaultPrim = root
    layer.pseudoRoot.SetInfo("metersPerUnit", 1.0)
    layer.pseudoRoot.SetInfo("kilogramsPerUnit", 1.0)
    layer.pseudoRoot.SetInfo("upAxis", "Z")


def set_time_range(layer: Any, fps: float, first: int, last: int) -> None:
    """Both rates and the range, in time codes.

    Both rates, since readers differ in the one they take and in what they assume without it.
    """
    layer.timeCodesPerSecond = fps
    layer.framesPerSecond = fps
    layer.startTimeCode = first
    layer.endTimeCode = last


def set_provenance(layer: Any, facts: Mapping[str, str | int | float]) -> None:
    """Store the facts under the package's key of customLayerData."""
    layer.customLayerData = {KEY: dict(facts)}
