"""The table at the end of a run."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

from rich.table import Table

from balloon_usd.batch.record import Status
from balloon_usd.cli.console import Terminal
from balloon_usd.language.pressures import kilopascals
from balloon_usd.quality.joints import SLIPPED
from balloon_usd.quality.line import quality_line
from balloon_usd.quality.measures import Verdict
from balloon_usd.quality.ranking import worst_first

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from balloon_usd.batch.order import Order
    from balloon_usd.batch.record import Record

MEGABYTE = 1e6
CENTIMETRES = 100.0
"""In a metre."""
MOST_ROWS = 64
"""Recipes that are listed one by one; of more, only what needs attention."""
WORST = 8
"""Figures of a batch whose quality is told."""
THERE = (Status.DONE, Status.SKIPPED)


def print_summary(records: Sequence[Record], order: Order, seconds: float, device: str) -> None:
    """Print what was written and how fast, on the standard stream.

    Args:
        records: one a recipe.
        order: what was asked for.
        seconds: time that all took.
        device: where it was computed; "" where nothing was.
    """
    if not any(record.name for record in records):
        return
    console = Terminal(soft_wrap=True, highlight=False)
    listed = records if len(records) <= MOST_ROWS else [r for r in records if r.status not in THERE]
    if listed:
        console.print(_table(listed), no_wrap=True, crop=False)
    if len(listed) < len(records):
        console.print(
            f"{len(records) - len(listed)} more are told in {order.folder / 'batch.jsonl'}", markup=False
        )
    for line in (*_warnings(records), *_qualities(records)):
        console.print(line, markup=False)
    console.print(_totals(records, order, seconds, device), markup=False)
    if len(records) <= MOST_ROWS:
        for line in _files(records, order):
            console.print(line, markup=False)


def _table(records: Sequence[Record]) -> Table:
    table = Table("sculpture", box=None, pad_edge=False)
    for heading in ("frames", "animation", "tail left", "highest stretch", "wall", "size"):
        table.add_column(heading, justify="right")
    for record in records:
        name = record.name or record.recipe
        if record.status not in THERE:
            table.add_row(name, str(record.status))
            continue
        told = record.summary
        length = f"{record.frames / told['fps']:.1f} s"
        tails = ", ".join(f"{CENTIMETRES * tail:.1f} cm" for tail in told["tails_left"].values())
        stretch = f"{told['highest_stretch']:.1f}"
        load = f"{told['burst_load']:.0%} of burst" if told.get("burst_load") else ""
        size = f"{record.size / MEGABYTE:.1f} MB"
        table.add_row(name, str(record.frames), length, tails, stretch, load, size)
    return table


def _warnings(records: Sequence[Record]) -> Iterator[str]:
    for record in records:
        told = record.summary
        # Records of earlier versions have no loads.
        if told.get("bursts") and "burst_load" in told:
            load = f"its wall has {told['burst_load']:.0%} of the load at which latex tears"
            remedy = _remedy(_measured(told, "necks"))
            yield f"{record.name}: {told['most_loaded']} would burst: {load}: {remedy}"
        for balloon, (bubble, pressure) in told.get("hard", {}).items():
            hardest = f"the hardest, {bubble}, has {kilopascals(pressure)}"
            yield f"{record.name}: {balloon} has run out of tail: {hardest}: leave more tail"
        if off := told.get("gas_off"):
            listed = ", ".join(f"{bubble} {share:.0%}" for bubble, share in off.items())
            yield f"{record.name}: not the gas of the plan: {listed}: make them longer, or leave more tail"
        if undone := told.get("undone"):
            slipped = any(SLIPPED in each for each in undone)
            remedy = "more turns, or more friction" if slipped else "lock them, with 2 turns or more"
            yield f"{record.name}: came undone: {', '.join(undone)}: {remedy}"
        if stale := told.get("stale"):
            details = ", ".join(stale)
            why = "it showed another recipe, or other frames"
            yield f"{record.name}: detail {details} is gone: {why}: run it again"
        if (lean := _measured(told, "lean")).get("verdict") == Verdict.OFF:
            remedy = "put its feet farther apart, or pose: hold"
            yield f"{record.name}: fell over, leaning {lean['value']:.0f} degrees: {remedy}"


def _measured(told: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    """Return a measure of the quality in what is told of a figure, empty where there is none."""
    found: Mapping[str, Any] = (told.get("quality") or {}).get(key, {})
    return found


def _remedy(necks: Mapping[str, Any]) -> str:
    """Return what helps where a wall would burst; `necks`: that measure of its quality."""
    if necks.get("verdict") == Verdict.OFF:
        return f"rubber of the neck at {necks['joint']} is drawn in: longer bubbles there, or fewer"
    return "leave more tail, blow a round balloon up less, or make what is folded longer"


def _qualities(records: Sequence[Record]) -> Iterator[str]:
    """Tell the quality of a figure that was made alone, or of the worst of a batch."""
    judged = {record.name: quality for record in records if (quality := record.summary.get("quality"))}
    if len(records) == 1:
        yield from (f"quality: {quality_line(quality)}" for quality in judged.values())
        return
    off = worst_first([name for name, quality in judged.items() if quality["off"]], judged.__getitem__)
    for name in off[:WORST]:
        yield f"quality of {name}: {quality_line(judged[name])}"
    if len(off) > WORST:
        yield f"{len(off) - WORST} more of {len(judged)} figures are off"


def _totals(records: Sequence[Record], order: Order, seconds: float, device: str) -> str:
    made = [record for record in records if record.status is Status.DONE]
    frames = sum(record.frames for record in made)
    counts = Counter("made" if record.status is Status.DONE else str(record.status) for record in records)
    told = ", ".join(f"{count} {what}" for what, count in counts.items())
    where = f", {order.detail} on {device}" if device else ""
    if not made:
        return f"{told} in {seconds:.1f} s{where}"
    several = f"{told}: " if len(records) > 1 else ""
    rate = frames / max(seconds, 1e-9)
    return f"{several}{frames} frames in {seconds:.1f} s, {rate:.0f} frames/s{where}"


def _files(records: Sequence[Record], order: Order) -> Iterator[str]:
    names = {"stage": "stage", "shot": "shot", "report": "report", "sheet": "contact sheet"}
    for kind, name in names.items():
        for record in records:
            for file in record.products.get(kind, ()):
                yield f"{name} {order.folder / file}"
