"""The report as JSON: one line for each row of numbers, the same bytes for the same frames."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from balloon_usd.report.crossings import crossing_rows

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from balloon_usd.report.history import History

REPORT_FORMAT = 1
"""Version of the report; it grows when a key changes its meaning or goes."""

UNITS = {"time": "s", "pressure": "Pa", "volume": "m3", "stretch": "1", "tail": "m", "contact": "N"}
"""Units of all numbers by key. Pressure is gauge pressure; stretch is a ratio of lengths; contact is the sum
of the normal forces of all walls that touch a bubble.
"""
DIGITS = {"time": 6, "pressure": 1, "volume": 10, "stretch": 4, "tail": 5, "contact": 3}
"""Digits after the point: beyond them is the round-off of single precision."""
INDENT = "  "


def report_data(
    history: History,
    *,
    detail: str,
    provenance: Mapping[str, str],
    quality: Mapping[str, Any] | None = None,
    failed: str = "",
) -> dict[str, Any]:
    """Return a report as plain data, its keys in a fixed order.

    Args:
        history: the frames that were seen.
        detail: level of detail of the mesh.
        provenance: where the numbers come from: recipe, its hash and the solver.
        quality: of the finished figure, see `QualityWatch`; None if its last frame was not seen.
        failed: why the simulation ended after the last of the frames, if it did before its end.
    """
    recipe = history.plan.recipe
    most = recipe.physics.traits.burst_stretch
    rows = {"pressure": history.pressure, "volume": history.volume, "stretch": history.stretch}
    if history.contact is not None:
        rows["contact"] = history.contact
    return {
        "format": REPORT_FORMAT,
        "name": recipe.name,
        "title": recipe.title,
        **provenance,
        "model": recipe.physics.model,
        "detail": detail,
        "fps": recipe.fps,
        "units": UNITS,
        "burst_stretch": None if most is None else round(most, DIGITS["stretch"]),
        "steps": [
            {
                "step": mark.step,
                "text": mark.text,
                **_moment(mark.time_code, recipe.fps),
            }
            for mark in history.marks
        ],
        "undone": [{"joint": name, **_moment(code, recipe.fps)} for name, code in history.undone],
        "failed": _failure(history, failed),
        "quality": None if quality is None else dict(quality),
        "crossings": crossing_rows(history.crossings),
        "time_code": list(history.time_codes),
        "time": _rounded("time", history.times),
        "bubbles": [
            {
                "name": bubble.name,
                "balloon": bubble.balloon,
                **{key: _rounded(key, columns[:, index]) for key, columns in rows.items()},
            }
            for index, bubble in enumerate(history.plan.bubbles)
        ],
        "balloons": [
            {"name": name, "tail": _rounded("tail", history.tail[:, index])}
            for index, name in enumerate(history.tail_names)
        ],
    }


def _failure(history: History, cause: str) -> dict[str, Any] | None:
    if not cause:
        return None
    last = history.time_codes[-1]
    return {"cause": cause, "last_good_frame": last, "time": _moment(last, history.plan.recipe.fps)["time"]}


def report_text(data: Mapping[str, Any]) -> str:
    """Return a report as JSON text that people can read, too: a list of numbers stays on one line."""
    return _block(data, "") + "\n"


def _moment(time_code: int, fps: float) -> dict[str, float]:
    return {"time_code": time_code, "time": round((time_code - 1) / fps, DIGITS["time"])}


def _rounded(key: str, values: Iterable[float]) -> list[float]:
    # Adding zero turns -0.0 into 0.0.
    return [round(float(value), DIGITS[key]) + 0.0 for value in values]


def _block(value: Any, indent: str) -> str:
    """Return JSON text with a line for each entry of a mapping that holds lists or mappings."""
    deeper = indent + INDENT
    if isinstance(value, dict) and any(isinstance(entry, (dict, list)) for entry in value.values()):
        entries = [f"{_line(key)}: {_block(entry, deeper)}" for key, entry in value.items()]
        return _wrapped("{", entries, "}", indent)
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return _wrapped("[", [_block(entry, deeper) for entry in value], "]", indent)
    return _line(value)


def _wrapped(begin: str, entries: list[str], end: str, indent: str) -> str:
    deeper = f"\n{indent}{INDENT}"
    return f"{begin}{deeper}{f',{deeper}'.join(entries)}\n{indent}{end}"


def _line(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
