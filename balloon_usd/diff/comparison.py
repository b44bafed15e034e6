"""Two stages, compared prim by prim while they are read: memory does not grow with the time codes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from balloon_usd.diff.difference import ONLY, Difference
from balloon_usd.diff.measuring import measure_surfaces
from balloon_usd.diff.metadata import metadata_differences, prim_metadata, stage_metadata, variant_metadata
from balloon_usd.diff.movement_text import told_mean, told_movements
from balloon_usd.diff.pairs import PrimPairs
from balloon_usd.diff.properties import property_differences
from balloon_usd.diff.tolerance import EXACT, Allowed, Tolerances
from balloon_usd.openusd import UsdGeom, each_step_alone

if TYPE_CHECKING:
    from collections.abc import Iterator

POINTS = "points"
UNITS = frozenset({"metersPerUnit", "upAxis"})


@each_step_alone
def differences(one: Any, other: Any, *, tolerance: float | Tolerances = EXACT) -> Iterator[str]:
    """What differs between two stages as they are composed, a sentence each; how that is done does not count.

    Variant sets are part of how a stage is composed. The asset's identifier is its own file and may differ.

    Args:
        one: first `Usd.Stage`.
        other: second `Usd.Stage`.
        tolerance: a number is allowed of all floats, absolutely and relative to their size.
    """
    if not isinstance(tolerance, Tolerances):
        tolerance = Tolerances(Allowed(tolerance, tolerance))
    for difference in Comparing(tolerance, composed_only=True).differences(one, other):
        yield str(difference)


@dataclass
class Comparing:
    """One pass over two stages."""

    tolerances: Tolerances = EXACT
    composed_only: bool = False
    """Whether variant sets and the asset's identifier do not count."""
    _pairs: PrimPairs = field(default_factory=PrimPairs)

    def differences(self, one: Any, other: Any) -> Iterator[Difference]:
        """What differs between two stages, parents first."""
        for key, text in metadata_differences(stage_metadata(one), stage_metadata(other)):
            if key in UNITS:
                self._pairs.elsewhere.append("/")
            yield Difference("", f"{key}: {text}")
        found = set()
        for first, second in self._pairs.walk(one.GetPseudoRoot(), other.GetPseudoRoot()):
            if first and second:
                for difference in self._of_prims(first, second):
                    found.add(difference.prim)
                    yield difference
            else:
                yield Difference(str((first or second).GetPath()), ONLY[not first])
        for path, others in self._pairs.repeated.items():
            if any(prim.startswith(f"{path}/") for prim in found):
                yield Difference(path, f"the same in {len(others)} more instances: {_listed(others)}")

    def _of_prims(self, one: Any, other: Any) -> Iterator[Difference]:
        path = str(one.GetPath())
        heads = [prim_metadata(prim, identifier=not self.composed_only) for prim in (one, other)]
        for key, text in metadata_differences(*heads):
            yield Difference(path, f"{key}: {text}")
        if not self.composed_only:
            for key, text in metadata_differences(variant_metadata(one), variant_metadata(other)):
                yield Difference(path, f"{key}: {text}")
        touched: set[str] = set()
        found = [*property_differences(one, other, self.tolerances, touched)]
        if any(difference.name.startswith("xformOp") for difference in found):
            self._pairs.elsewhere.append(path)
        if one.IsA(UsdGeom.PointBased) and other.IsA(UsdGeom.PointBased):
            beyond = any(difference.name == POINTS for difference in found) or self._pairs.stands_elsewhere(
                path
            )
            if beyond or (POINTS in touched and self.tolerances.rms is not None):
                yield from self._of_surfaces(one, other, beyond=beyond)
        yield from found

    def _of_surfaces(self, one: Any, other: Any, *, beyond: bool) -> Iterator[Difference]:
        """How far a surface moved; if its points are within the tolerance, only their mean counts."""
        path = str(one.GetPath())
        measured = measure_surfaces(one, other)
        if measured.unlike:
            yield Difference(path, measured.unlike)
        if beyond:
            scale = UsdGeom.GetStageMetersPerUnit(one.GetStage())
            yield from told_movements(path, measured, scale * self.tolerances.of(POINTS).absolute)
        elif self.tolerances.rms is not None:
            yield from told_mean(path, measured, self.tolerances.rms)


def _listed(paths: list[str]) -> str:
    return ", ".join(paths[:3]) + (", ..." if len(paths) > 3 else "")
