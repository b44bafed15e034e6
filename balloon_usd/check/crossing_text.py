"""Crossings for people, in a line a stage, and for programs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.check.fault import OURS
from balloon_usd.quality.crossing_history import pair_text

if TYPE_CHECKING:
    from balloon_usd.check.crossings import CrossingReport

FORMAT = 1
"""Version of the document, that of all of `check`."""
NAMED = 3
"""Pairs of bubbles that are named in the line."""
MILLI = 1e3
"""Millimetres in a metre."""
DIGITS = 6
"""Of a depth in metres."""
RULE = "crossings"
REMEDY = "see which steps bring these bubbles together: give them more room, or `--detail preview`"


def crossings_line(report: CrossingReport) -> str:
    """Return the crossings of a stage in one line; why there are none where they cannot be counted."""
    if report.unreadable:
        return report.unreadable
    parts = [*_counts(report), *_pairs(report)]
    if report.frames[report.last].in_necks:
        parts.append(f"{report.frames[report.last].in_necks} in necks")
    if count := len(report.left_out):
        which = "1 mesh left out that is" if count == 1 else f"{count} meshes left out that are"
        parts.append(f"{which} not closed")
    return f"{report.stage}: {', '.join(parts)}"


def _counts(report: CrossingReport) -> list[str]:
    worst, last = report.worst, report.last
    frames = "1 frame" if len(report.frames) == 1 else f"{len(report.frames)} frames"
    if not report.any:
        return [f"0 crossings in {frames}"]
    most, end = report.frames[worst].count, report.frames[last].count
    deepest = f"{MILLI * max(report.depth.values()):.1f} mm deep"
    if worst == last:
        when = "" if last is None else f" in the last frame, {last:g}, the worst of {frames}"
        return [f"{_crossings(most)}{when}", deepest]
    return [f"{_crossings(most)} in frame {worst:g}, the worst of {frames}, {end} in the last one", deepest]


def _crossings(count: int) -> str:
    return "1 crossing" if count == 1 else f"{count} crossings"


def _pairs(report: CrossingReport) -> list[str]:
    pairs = report.pairs()
    named = [f"{pair_text(pair)} {most}" for pair, most in pairs[:NAMED]]
    others = len(pairs) - NAMED
    return [*named, f"{others} other pair{'s' if others > 1 else ''}"] if others > 0 else named


def crossings_document(report: CrossingReport) -> dict[str, Any]:
    """Return the crossings of a stage as plain lists and dictionaries, as `document_of` has faults."""
    result = "unreadable" if report.unreadable else "faults" if report.any else "fine"
    stage: dict[str, Any] = {
        "stage": report.stage.encode("utf-8", "backslashreplace").decode(),
        "result": result,
        "unreadable": report.unreadable,
        "kind": report.kind.value,
        "faults": [_fault(report)] if result == "faults" else [],
    }
    counted = {} if report.unreadable else {"crossings": _rows(report)}
    return {"format": FORMAT, "stages": [{**stage, **counted}]}


def _rows(report: CrossingReport) -> dict[str, Any]:
    frames = report.frames.values()
    return {
        "time_code": list(report.frames),
        "count": [found.count for found in frames],
        "in_necks": [found.in_necks for found in frames],
        "worst": _moment(report, report.worst),
        "last": _moment(report, report.last),
        "bubbles": [{"pair": list(pair), "most": most} for pair, most in report.pairs()],
        "left_out": report.left_out,
    }


def _moment(report: CrossingReport, time: float | None) -> dict[str, Any]:
    found = report.frames[time]
    bubbles = [{"pair": list(pair), "count": count} for pair, count in found.pairs.items()]
    return {
        "time_code": time,
        "count": found.count,
        "in_necks": found.in_necks,
        "depth": round(report.depth[time], DIGITS),
        "bubbles": bubbles,
    }


def _fault(report: CrossingReport) -> dict[str, Any]:
    return {
        "by": OURS,
        "rule": RULE,
        "prim": "",
        "time_code": report.worst,
        "variants": "",
        "text": ", ".join([*_counts(report), *_pairs(report)]),
        "remedy": REMEDY,
    }
