"""The plan as a drawing: every balloon to scale, finished and before the twists, and the sculpture graph."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.bubble_shape import tube_diameter
from balloon_usd.language.lengths import cm
from balloon_usd.plan import svg
from balloon_usd.plan.graph_drawing import HEIGHT, graph_shapes, graph_width
from balloon_usd.plan.open_tube import softened

if TYPE_CHECKING:
    from collections.abc import Container, Iterator, Sequence

    from numpy.typing import NDArray

    from balloon_usd.plan.after_step import AfterStep
    from balloon_usd.plan.model import Plan
    from balloon_usd.plan.shaped import Shaped
    from balloon_usd.plan.strip import PlannedBubble, Strip

SCALE = 800.0
"""Drawing units for a metre."""
MARGIN = 40.0
_HEAD = 44.0
_ABOVE_TUBE = 84.0
_BELOW_TUBE = 96.0
_ABOVE_MESH = 28.0
_LINE = 16.0
_STYLE = (
    "text{font:11px sans-serif;fill:#333}.name{text-anchor:middle}.head{font-size:16px;font-weight:bold}"
    ".mark{stroke:#333;stroke-width:0.6}.bubble{stroke:#333;stroke-width:0.8;fill-opacity:0.8}"
    ".popped{fill:none;stroke:#333;stroke-width:0.8;stroke-dasharray:4 3}"
    ".flat,.capsule{fill:#e8e2d8;stroke:#333;stroke-width:0.6}.empty{fill:#fff;stroke:#333;stroke-width:0.6}"
    ".edge{fill:none;stroke-width:9;stroke-linecap:round;stroke-opacity:0.55}"
    ".joint{fill:#333}.merged{fill:#fff;stroke:#333;stroke-width:2}"
)


def plan_svg(plan: Plan, after: AfterStep | None = None) -> str:
    """Return the plan as an SVG drawing: strips inflated and flat to one scale, then the graph.

    `after`: a step after which it is drawn, instead of the last.
    """
    graph = plan.graph if after is None else after.graph
    colors = {name: svg.srgb(plan.recipe.balloons[name].color.rgb) for name in plan.strips}
    title = plan.recipe.title or plan.recipe.name
    title = title if after is None else f"{title}, {after.what}"
    popped = plan.recipe.piece.popped if after is None else after.popped
    body = [svg.text(title, (MARGIN, 28.0), "head")]
    top, width = _HEAD, 0.0 if plan.of_meshes else graph_width(graph)
    for name, strip in plan.strips.items():
        if strip.shape is not None:
            body += _mesh_shapes(strip, strip.shape, top)
            top += _ABOVE_MESH + SCALE * float(_printed(strip.shape)[1].max()) + MARGIN
            width = max(width, SCALE * max(strip.shape.surface.size))
            continue
        bubbles = strip.bubbles if after is None else after.made(strip)
        body += _strip_shapes(strip, bubbles, popped, colors[name], top)
        top += _strip_height(strip)
        before = strip.capsule_length if strip.capsule else strip.size.length
        width = max(width, SCALE * max(strip.bubbles[-1].end, before))
    if not plan.of_meshes:
        body += graph_shapes(graph, colors, (MARGIN, top))
        top += HEIGHT
        for contact in graph.contacts:
            top += _LINE
            body.append(svg.text(contact.text, (MARGIN, top)))
    width, height = width + 2.0 * MARGIN, top + MARGIN
    size = f'width="{width:.0f}" height="{height:.0f}" viewBox="0 0 {width:.0f} {height:.0f}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size}><style>{_STYLE}</style>'
    return "\n".join([head, '<rect width="100%" height="100%" fill="#fff"/>', *body, "</svg>"]) + "\n"


def _mesh_shapes(strip: Strip, shape: Shaped, top: float) -> Iterator[str]:
    """A flat balloon from a mesh, seen across its thinnest side."""
    swell = f"blown up to {1e3 * shape.volume:.2f} L"
    yield svg.text(
        f"{strip.balloon}: mesh, {cm(max(shape.surface.size))} flat, {swell}", (MARGIN, top + 12.0)
    )
    across, down = _printed(shape)
    place = np.stack([MARGIN + SCALE * across, top + _ABOVE_MESH + SCALE * down], axis=1)
    yield svg.polygons([list(map(tuple, face)) for face in place[shape.surface.quads].tolist()], "flat")


def _printed(shape: Shaped) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return how far right and down every point lies in the box of a shape (V,) each, m."""
    points = shape.surface.points
    right, up = (axis for axis in range(3) if axis != int(np.argmin(shape.surface.size)))
    return points[:, right] - points[:, right].min(), points[:, up].max() - points[:, up]


def _thickness(strip: Strip) -> float:
    if strip.is_round:
        return 2.0 * strip.inflated_radius * SCALE
    return tube_diameter(strip.size, softened(strip.rubber)) * SCALE


def _strip_height(strip: Strip) -> float:
    return _ABOVE_TUBE + _thickness(strip) + _BELOW_TUBE + (_thickness(strip) if strip.capsule else 0.0)


def _strip_shapes(
    strip: Strip, bubbles: Sequence[PlannedBubble], popped: Container[str], color: str, top: float
) -> Iterator[str]:
    thick = _thickness(strip)
    middle = top + _ABOVE_TUBE + 0.5 * thick
    yield svg.text(f"{strip.balloon}: {strip.size.name}, {_filling(strip)}", (MARGIN, top + 12.0))
    for bubble in bubbles:
        yield from _bubble_shapes(bubble, "" if bubble.name in popped else color, middle, thick)
    yield from _ruler(strip.bubbles[-1].end, middle + 0.5 * thick + 10.0)
    before = _capsule_shapes if strip.capsule else _flat_shapes
    yield from before(strip, middle + 0.5 * thick + 44.0)


def _filling(strip: Strip) -> str:
    if strip.is_round:
        text = f"blown up to a width of {cm(2.0 * strip.inflated_radius)}"
        return text if strip.overblown is None else f"{text}, from {cm(strip.overblown)}"
    return f"capsule of {cm(strip.capsule_length)}" if strip.capsule else f"leave {cm(strip.tail)} flat"


def _bubble_shapes(bubble: PlannedBubble, color: str, middle: float, thick: float) -> Iterator[str]:
    """A bubble, and its name; one without a colour was popped."""
    left, wide = MARGIN + bubble.start * SCALE, bubble.length * SCALE
    # As the exact shapes: a bubble as long as the tube is wide is nearly as wide as the tube.
    high = min(thick, 1.3 * wide)
    rounding = 0.5 * min(wide, high)
    kind, told = ("bubble", "") if color else ("popped", ", popped")
    yield svg.rectangle((left, middle - 0.5 * high), wide, high, kind, color, rounding)
    label = (left + 0.5 * wide, middle - 0.5 * thick - 6.0)
    yield svg.text(f"{bubble.name} {bubble.length * 100.0:.3g}{told}", label, degrees=-28.0)


def _ruler(length: float, y: float) -> Iterator[str]:
    yield svg.line((MARGIN, y), (MARGIN + length * SCALE, y))
    for decimetre in range(math.floor(length * 10.0) + 1):
        x = MARGIN + decimetre * 0.1 * SCALE
        yield svg.line((x, y - 3.0), (x, y + 3.0))
        yield svg.text(f"{decimetre * 10}", (x, y + 14.0), "name")


def _flat_shapes(strip: Strip, top: float) -> Iterator[str]:
    height = strip.size.flat_width * SCALE
    if strip.is_round:
        wide = strip.size.length * SCALE
        yield svg.rectangle((MARGIN, top), wide, height, "flat", rx=0.5 * min(height, wide))
        yield from _marks(strip, top, height)
        return
    inflated = (strip.size.length - strip.tail) * SCALE
    yield svg.rectangle((MARGIN, top), inflated, height, "flat")
    yield svg.rectangle((MARGIN + inflated, top), strip.tail * SCALE, height, "empty")
    yield from _marks(strip, top, height)


def _capsule_shapes(strip: Strip, top: float) -> Iterator[str]:
    height = _thickness(strip)
    yield svg.rectangle((MARGIN, top), strip.capsule_length * SCALE, height, "capsule", rx=0.5 * height)
    yield from _marks(strip, top, height)


def _marks(strip: Strip, top: float, height: float) -> Iterator[str]:
    """Where the joints are made."""
    for bubble in strip.bubbles[:-1]:
        x = MARGIN + bubble.rest_end * SCALE
        yield svg.line((x, top - 4.0), (x, top + height + 4.0))
