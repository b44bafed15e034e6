"""The blown-up balloon before anything is twisted: where its flat rubber lies and how wide it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.plan.necks import wall_length

if TYPE_CHECKING:
    from balloon_usd.plan.strip import Strip

Floats = NDArray[np.float64]

SHORTEST_TAIL = 1e-3
"""Least share of a balloon that is drawn flat, so that its tip lies beyond its front."""
NECKS = 2
"""Necks of a bubble of a tube: its knot or a joint, and a joint."""
NECK_AT_KNOT = 0.55
"""Radius at the knot, in R0."""


@dataclass(frozen=True)
class BlownShape:
    """A straight balloon along +x, blown up as far as its plan says."""

    flat: Floats
    """Unstressed distances from the knot, (N,), m, ascending."""
    place: Floats
    """Where they lie, (N,), m."""
    end: float
    """Where the blown-up part ends, m."""
    wide: float
    """Its radius, m."""
    thin: float
    """Radius of the flat tail, m; the capsule has none."""
    neck: float
    """Radius at the knot, m."""

    def place_of(self, along: Floats) -> Floats:
        """Return where rubber lies (m) that is this far from the knot when flat (m)."""
        return np.interp(along, self.flat, self.place)

    def radius_at(self, x: Floats) -> Floats:
        """Return the radius (m) at places along the balloon (m): a tube with round ends, then the tail."""
        inside = np.minimum(x, self.end - x) / self.wide
        dome = self.wide * np.sqrt(np.clip(inside * (2.0 - inside), 0.0, 1.0))
        dome = np.where(inside > 1.0, self.wide, dome)
        least = np.where(x < 0.5 * self.end, self.neck, self.thin)
        return np.asarray(np.where(inside > 0.0, np.maximum(dome, least), least))


def blown_shape(strip: Strip) -> BlownShape:
    """Return the shape of a strip that is blown up and not yet twisted."""
    state = maxwell_state(strip.rubber)
    wide = strip.size.radius * state.bulged.a
    if strip.capsule:
        ends = np.array([0.0, strip.capsule_length])
        return BlownShape(ends, ends, strip.capsule_length, wide, 0.0, 0.0)
    flat, place = [0.0], [0.0]
    for bubble in strip.bubbles[:-1]:
        flat.append(bubble.rest_end)
        place.append(place[-1] + wall_length(bubble.length, wide, NECKS))
    last = strip.bubbles[-1]
    front = last.rest_start + last.length / state.bulged.b
    end = place[-1] + wall_length(last.length, wide, 1)
    tip = max(strip.size.length, front + SHORTEST_TAIL * strip.size.length)
    return BlownShape(
        np.array([*flat, front, tip]),
        np.array([*place, end, end + (tip - front) * state.thin.b]),
        end,
        wide,
        strip.size.radius * state.thin.a,
        NECK_AT_KNOT * strip.size.radius,
    )
