"""The blown-up balloon before anything is twisted: where its flat rubber lies and how wide it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.tube_theory import maxwell_state

if TYPE_CHECKING:
    from balloon_usd.plan.strip import Strip

Floats = NDArray[np.float64]

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
    last = strip.bubbles[-1]
    if strip.capsule:
        ends = np.array([0.0, strip.capsule_length])
        return BlownShape(ends, ends, strip.capsule_length, wide, 0.0, 0.0)
    flat = [strip.bubbles[0].rest_start, *(b.rest_end for b in strip.bubbles[:-1])]
    place = [strip.bubbles[0].start, *(b.end for b in strip.bubbles[:-1])]
    front = last.rest_start + last.length / state.bulged.b
    tip = max(strip.size.length, front + 1e-4)
    flat += [front, tip]
    place += [last.end, last.end + (tip - front) * state.thin.b]
    return BlownShape(
        np.array(flat),
        np.array(place),
        last.end,
        wide,
        strip.size.radius * state.thin.a,
        NECK_AT_KNOT * strip.size.radius,
    )
