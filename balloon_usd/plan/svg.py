"""The few SVG shapes that the plan's drawing is made of."""

from __future__ import annotations

from html import escape

Point = tuple[float, float]


def text(words: str, at: Point, kind: str = "", degrees: float = 0.0) -> str:
    """Return a line of text at a place, turned by some degrees about it."""
    place = f'x="{at[0]:.1f}" y="{at[1]:.1f}"'
    turn = f' transform="rotate({degrees:g} {at[0]:.1f} {at[1]:.1f})"' if degrees else ""
    return f"<text{_class(kind)} {place}{turn}>{escape(words)}</text>"


def rectangle(corner: Point, width: float, height: float, kind: str, color: str = "", rx: float = 0.0) -> str:
    """Return a rectangle from its upper left corner, with corners rounded by rx."""
    place = f'x="{corner[0]:.1f}" y="{corner[1]:.1f}" width="{width:.1f}" height="{height:.1f}"'
    rounded = f' rx="{rx:.1f}"' if rx else ""
    filled = f' fill="{color}"' if color else ""
    return f"<rect{_class(kind)}{filled} {place}{rounded}/>"


def line(start: Point, end: Point) -> str:
    """Return a thin line."""
    return f'<line class="mark" x1="{start[0]:.1f}" y1="{start[1]:.1f}" x2="{end[0]:.1f}" y2="{end[1]:.1f}"/>'


def polygons(corners: list[list[Point]], kind: str) -> str:
    """Return closed polygons as one shape."""
    runs = (" ".join(f"{x:.1f},{y:.1f}" for x, y in polygon) for polygon in corners)
    return f'<path{_class(kind)} d="{"".join(f"M{run}Z" for run in runs)}"/>'


def curve(controls: list[Point], color: str) -> str:
    """Return a thick Bézier curve: quadratic through three points, cubic through four."""
    first, *others = (f"{x:.1f},{y:.1f}" for x, y in controls)
    letter = "Q" if len(others) == 2 else "C"
    return f'<path class="edge" stroke="{color}" d="M{first} {letter}{" ".join(others)}"/>'


def circle(center: Point, radius: float, kind: str, title: str) -> str:
    """Return a circle with a tool tip."""
    place = f'cx="{center[0]:.1f}" cy="{center[1]:.1f}" r="{radius:g}"'
    return f"<circle{_class(kind)} {place}><title>{escape(title)}</title></circle>"


def srgb(linear: tuple[float, float, float]) -> str:
    """Return a linear colour as #rrggbb (IEC 61966-2-1)."""
    encoded = [12.92 * c if c <= 0.0031308 else 1.055 * c ** (1.0 / 2.4) - 0.055 for c in linear]
    return "#" + "".join(f"{round(255.0 * c):02x}" for c in encoded)


def _class(kind: str) -> str:
    return f' class="{kind}"' if kind else ""
