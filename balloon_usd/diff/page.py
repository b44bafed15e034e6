"""One HTML page with everything that differs, pictures included."""

from __future__ import annotations

import base64
from html import escape
from io import BytesIO
from itertools import groupby
from typing import TYPE_CHECKING

from balloon_usd.diff.moments import movements_of
from balloon_usd.diff.movement_text import length_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from PIL import Image

    from balloon_usd.diff.movement import Movement
    from balloon_usd.diff.two_files import Comparison

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; color: #26282e; background: #f7f7f9; margin: 2rem auto;
  max-width: 96rem; padding: 0 1.5rem; }
h1 { font-size: 1.5rem; margin-bottom: 0; } h2 { font-size: 1.1rem; margin-top: 2.2rem; }
code { font: 13px ui-monospace, monospace; } .files { color: #787c86; }
table { border-collapse: collapse; } td, th { padding: .25rem 1.2rem .25rem 0; text-align: left;
  vertical-align: top; border-bottom: 1px solid #e2e2e6; } th { color: #787c86; font-weight: normal; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
img { max-width: 100%; } svg { display: block; } polyline { fill: none; stroke: #d6283a; stroke-width: 1.5; }
"""
CHART = (220, 26)
"""Width and height of the curve of distances (pixels)."""


def diff_page(comparison: Comparison, sheet: Image.Image | None) -> str:
    """Write the page.

    Args:
        comparison: what was found.
        sheet: both stages side by side; None for stages that show nothing.
    """
    verdict = "The stages are the same" if comparison.same else "The stages differ"
    parts = [
        "<!doctype html>",
        f'<html lang="en"><meta charset="utf-8"><title>{verdict}</title><style>{STYLE}</style>',
        f"<h1>{verdict}</h1>",
        f'<p class="files"><code>{escape(str(comparison.first))}</code><br>'
        f"<code>{escape(str(comparison.second))}</code></p>",
        *_movements(movements_of(comparison)),
    ]
    if sheet is not None:
        parts += ["<h2>Side by side</h2>", f'<img alt="both stages side by side" src="{_data(sheet)}">']
    parts += [*_differences(comparison), "</html>"]
    return "\n".join(parts)


def _movements(moved: list[Movement]) -> Iterator[str]:
    """Yield the table of what moved how far."""
    if not moved:
        return
    yield "<h2>What moved</h2><table><tr><th>bubble"
    for heading in ("largest distance", "at", "vertex", "rms", "volume"):
        yield f'<th class="number">{heading}'
    yield "<th>distance over the time codes that differ</tr>"
    for movement in moved:
        worst = movement.worst
        when = "" if worst.time_code is None else f"{worst.time_code:g}"
        vertex = "" if worst.vertex < 0 else str(worst.vertex)
        rms = "" if worst.rms is None else length_text(worst.rms)
        volume = f"{100.0 * worst.growth:+.2g} %" if worst.volumes else ""
        cells = (length_text(worst.distance), when, vertex, rms, volume)
        numbers = "".join(f'<td class="number">{cell}' for cell in cells)
        yield f"<tr><td>{escape(movement.bubble) or 'whole surface'}{numbers}<td>{_curve(movement)}</tr>"
    yield "</table>"


def _curve(movement: Movement) -> str:
    """Draw the largest distance over time."""
    codes = [moment.time_code for moment in movement.moments if moment.time_code is not None]
    if len(codes) < 2:
        return ""
    (width, height), first = CHART, codes[0]
    across, up = width / (codes[-1] - first), (height - 2) / movement.worst.distance
    rows = zip(codes, (moment.distance for moment in movement.moments), strict=True)
    line = " ".join(f"{across * (code - first):.1f},{height - 1 - up * far:.1f}" for code, far in rows)
    return (
        f'<svg width="{width}" height="{height}"><polyline points="{line}"/></svg>{first:g} to {codes[-1]:g}'
    )


def _differences(comparison: Comparison) -> Iterator[str]:
    """Yield the table of all differences, prim by prim."""
    if comparison.same:
        return
    yield "<h2>All differences</h2><table>"
    places = groupby(comparison.differences, key=lambda difference: (difference.selection, difference.prim))
    for (selection, prim), group in places:
        for number, difference in enumerate(group):
            place = f"[{selection}] {prim}" if selection else prim or "stage"
            cells = place if number == 0 else "", difference.name, difference.text
            first, name, text = (escape(cell) for cell in cells)
            yield f"<tr><td><code>{first}</code><td><code>{name}</code><td>{text}</tr>"
    yield "</table>"


def _data(sheet: Image.Image) -> str:
    encoded = BytesIO()
    sheet.save(encoded, format="PNG")
    return f"data:image/png;base64,{base64.b64encode(encoded.getvalue()).decode()}"
