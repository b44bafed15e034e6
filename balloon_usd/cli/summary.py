"""The table at the end of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.console import Console
from rich.table import Table

from balloon_usd.balloon.rubber import BURST_STRETCH
from balloon_usd.plan.lengths import cm

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.cli.perform import Outcome

MEGABYTE = 1e6


def print_summary(outcomes: Sequence[Outcome], seconds: float, detail: str, device: str) -> None:
    """Print what was written and how fast, on the standard stream.

    Args:
        outcomes: one a recipe.
        seconds: time that the simulation and the writing took.
        detail: level of detail.
        device: where it was computed.
    """
    table = Table("sculpture", box=None, pad_edge=False)
    for heading in ("frames", "animation", "tail left", "highest stretch", "size"):
        table.add_column(heading, justify="right")
    frames, files = 0, []
    for outcome in outcomes:
        recipe = outcome.plan.recipe
        if outcome.written is None:
            table.add_row(recipe.name, "failed")
            continue
        count = outcome.written.frames
        size = sum(file.stat().st_size for file in outcome.written.files) / MEGABYTE
        length = f"{count / recipe.fps:.1f} s"
        tails = ", ".join(cm(tail) for tail in outcome.tally.tails_left.values())
        bears = f" of {BURST_STRETCH:.1f}" if recipe.physics.model == "latex" else ""
        stretch = f"{outcome.tally.highest_stretch:.1f}{bears}"
        table.add_row(recipe.name, str(count), length, tails, stretch, f"{size:.1f} MB")
        files.append(f"stage {outcome.written.files[0]}")
        files += [f"shot {file}" for file in outcome.written.files if file.stem == f"{recipe.name}_shot"]
        frames += count
    console = Console(soft_wrap=True, highlight=False)
    console.print(table, no_wrap=True, crop=False)
    for outcome in outcomes:
        if outcome.tally.bursts:
            name, bubble = outcome.plan.recipe.name, outcome.tally.highest_bubble
            console.print(
                f"{name}: {bubble} would burst: use less gas, or make it longer or softer", soft_wrap=True
            )
        if outcome.tally.undone:
            name, undone = outcome.plan.recipe.name, ", ".join(outcome.tally.undone)
            console.print(f"{name}: came undone: {undone}: lock them, with 2 turns or more", soft_wrap=True)
    rate = frames / max(seconds, 1e-9)
    console.print(f"{frames} frames in {seconds:.1f} s, {rate:.0f} frames/s, {detail} on {device}")
    for file in files:
        console.print(file, markup=False)
