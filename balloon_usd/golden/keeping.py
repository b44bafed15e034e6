"""Simulate a recipe again, compare what comes out with its golden stage, and replace that if it is wished."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from balloon_usd.diff import Comparison, DiffError, Tolerances, compare_files
from balloon_usd.solver.performance import simulate
from balloon_usd.stage.workspace import Workspace
from balloon_usd.staging import write_stage

if TYPE_CHECKING:
    from balloon_usd.plan import Plan

DETAIL, DEVICE = "draft", "cpu"
"""Golden stages are made as every computer can make them."""


class Compare(Protocol):
    """What compares two stages, as `compare_files` does."""

    def __call__(
        self, first: Path, second: Path, *, tolerances: Tolerances = ..., variants: bool = ...
    ) -> Comparison:
        """Compare them; raises `DiffError` where that cannot be done."""


@dataclass(frozen=True)
class Update:
    """What was done about one golden stage."""

    comparison: Comparison | None
    """What the new one has that the earlier one has not; None if there was none that could be read."""
    written: bool


def perform(plan: Plan, folder: Path, frames: int | None = None) -> Path:
    """Simulate a plan in draft on the CPU, and return the file of its stage in a folder.

    Args:
        plan: what is made.
        folder: gets NAME/NAME.usda.
        frames: the first so many; None: all.

    Raises:
        SimulationFailed: the physics broke down.
        StageError: the stage cannot be written.
    """
    performance = simulate(plan, detail=DETAIL, device=DEVICE)
    return write_stage(plan, islice(performance, frames), folder, detail=DETAIL).files[0]


def verify(
    plan: Plan,
    folder: Path,
    tolerances: Tolerances,
    frames: int | None = None,
    *,
    compare: Compare = compare_files,
) -> Comparison:
    """Compare the golden stage of a plan with what comes out now.

    Args:
        plan: what is made.
        folder: of the golden stages.
        tolerances: what may differ.
        frames: the first so many; None: all.
        compare: compares two stages as `compare_files` does, which may crash with a damaged one.

    Raises:
        DiffError: there is no golden stage, or it is not whole.
        SimulationFailed: the physics broke down.
        StageError: no temporary stage can be written.
    """
    with tempfile.TemporaryDirectory() as aside:
        fresh = perform(plan, Path(aside), frames)
        return compare(folder / plan.recipe.name, fresh, tolerances=tolerances, variants=True)


def update(
    plan: Plan,
    folder: Path,
    tolerances: Tolerances,
    frames: int | None = None,
    *,
    always: bool = False,
    compare: Compare = compare_files,
) -> Update:
    """Replace the golden stage of a plan, the whole folder NAME, if what comes out now differs.

    Until the new one is whole, the earlier one stands.

    Args:
        plan: what is made.
        folder: of the golden stages; made if need be.
        tolerances: what may differ.
        frames: the first so many; None: all.
        always: replace it even if it is the same within the tolerances.
        compare: as in `verify`.

    Raises:
        SimulationFailed: the physics broke down.
        StageError: the stage cannot be written.
    """
    golden = folder / plan.recipe.name
    with Workspace(golden) as work:
        fresh = perform(plan, work.built.parent, frames)
        try:
            comparison = compare(golden, fresh, tolerances=tolerances, variants=True)
        except DiffError:
            comparison = None
        written = always or comparison is None or not comparison.same
        if written:
            work.publish()
    return Update(comparison, written)
