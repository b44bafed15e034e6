"""Two files, compared."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from balloon_usd.diff.comparison import Comparing
from balloon_usd.diff.difference import Difference
from balloon_usd.diff.error import DiffError
from balloon_usd.diff.opening import open_stage, reading, require_whole, stage_file
from balloon_usd.diff.tolerance import EXACT, Tolerances
from balloon_usd.diff.variants import selections
from balloon_usd.openusd import usd_access

if TYPE_CHECKING:
    from collections.abc import Iterator

MOST = 1000
"""Selections of variants that are compared: sets of variants multiply without end."""


@dataclass(frozen=True)
class Comparison:
    """What was found."""

    first: Path
    second: Path
    differences: tuple[Difference, ...]
    """Parents first."""

    @property
    def same(self) -> bool:
        """Whether nothing differs beyond the tolerance."""
        return not self.differences


@usd_access()
def compare_files(
    first: str | Path, second: str | Path, *, tolerances: Tolerances = EXACT, variants: bool = False
) -> Comparison:
    """Compare two stages, each a USD file of any maker or a folder NAME that holds NAME.usda.

    Structure, metadata, and names and selections of variants must be the same, floats within the tolerance.

    Args:
        first: the stage as it was.
        second: the stage as it is.
        tolerances: what floats may differ by.
        variants: compare what is in every selection of variants, too.

    Raises:
        DiffError: a stage cannot be read, no attribute has a name that a tolerance is given for, or there are
            too many selections of variants to say that all are the same.
    """
    files = stage_file(Path(first)), stage_file(Path(second))
    with reading():
        one, other = (open_stage(file) for file in files)
        _require_names(tolerances, one, other)
        found = [*Comparing(tolerances).differences(one, other)]
        if variants:
            found += _in_variants(files, one, other, tolerances, {str(difference) for difference in found})
    return Comparison(*files, tuple(found))


def _in_variants(
    files: tuple[Path, Path], one: Any, other: Any, tolerances: Tolerances, known: set[str]
) -> Iterator[Difference]:
    """What differs in other selections of variants and was not told of the stages as they are."""
    for number, (named, *stages) in enumerate(selections(one, other)):
        if number == MOST:
            others = f"the first {MOST} selections of variants, the others were not compared"
            if not known:
                raise DiffError(f"no difference in {others}")
            yield Difference("", f"these are of {others}")
            return
        for stage, file in zip(stages, files, strict=True):
            require_whole(stage, file)
        for difference in Comparing(tolerances, composed_only=True).differences(*stages):
            if str(difference) not in known:
                known.add(str(difference))
                yield replace(difference, selection=named)


def _require_names(tolerances: Tolerances, one: Any, other: Any) -> None:
    """Refuse a tolerance for an attribute that neither stage has.

    Raises:
        DiffError: with the nearest name that there is.
    """
    if not tolerances.named:
        return
    prims = (prim for stage in (one, other) for prim in stage.TraverseAll())
    names = {str(attribute.GetName()) for prim in prims for attribute in prim.GetAuthoredAttributes()}
    for text in tolerances.unknown_names(names):
        raise DiffError(f"tolerance: {text}")
