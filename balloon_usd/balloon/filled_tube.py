"""A tube that is blown up to its tip: a bubble with two rounded ends, harder than the Maxwell pressure.

Its ends lack gas of a straight tube, and a short one is harder than a long one as wide. Both are solved by
quadrature for tubes of every length that are about to burst. Of harder and softer ones the ends lack as much
of a tube that is as much wider: so the stretch round the middle of a tube of two and a half flat radii and
more is within 1 % of that by quadrature from 1.15 times the Maxwell pressure up to bursting, its pressure
within 7 %.

As long as a flat tail is left, whose front counts as steep, the tip is flat. It becomes round while as much
gas is pressed in as one end lacks.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.balloon.bubble_quadrature import bubble_at_stretch
from balloon_usd.balloon.bubble_shape import pinch_volume
from balloon_usd.balloon.rubber import BURST_STRETCH, UnloadedRubber
from balloon_usd.balloon.tube_theory import (
    LARGEST_STRETCH,
    TubeState,
    closed_tube_axial_stretch,
    closed_tube_state,
    fixed_length_tube_pressure,
    maxwell_state,
)

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Floats, Rubber
    from balloon_usd.balloon.sizes import BalloonSize

_NODES = 1025
_HARDER = np.geomspace(5.0e-4, 5.0, 33)
"""By how much short bubbles of one width are harder than a long tube, in its pressure: the longest is as good
as a tube, the shortest two flat radii long.
"""


class _Hardening(NamedTuple):
    """States of a tube from the bulged phase on, each (_NODES,)."""

    a: Floats
    b: Floats
    p_star: Floats


@lru_cache(maxsize=4096)
def filled_state(size: BalloonSize, rubber: Rubber, rest_length: float, volume: float) -> TubeState | None:
    """Return the state in the middle of a tube that is blown up to its tip; None where a tail is left.

    Its stretch along is that of a long tube as wide.

    Args:
        size: of the tube.
        rubber: with softening.
        rest_length: its unstressed length, m, above 0.
        volume: of its gas, m3.

    Raises:
        ValueError: the rubber has no bulged phase.
    """
    bulged = maxwell_state(rubber).bulged
    flat = math.pi * size.radius**2 * rest_length
    pinch = pinch_volume(size, rubber)
    over = volume - (flat * bulged.volume_ratio - 0.5 * pinch)
    if over <= 0.0:
        return None
    lacking, harder = _ends(rubber, rest_length / size.radius)
    rounded = min(0.5 + over / pinch, lacking)
    hardening = _hardening(rubber)
    volumes = flat * hardening.a**2 * hardening.b - rounded * pinch * (hardening.a / bulged.a) ** 3
    a, b, p_star = (float(np.interp(volume, volumes, values)) for values in hardening)
    # A flat end bears no more than a long tube does.
    round_share = min(2.0 * over / pinch, 1.0)
    return TubeState(p_star * (1.0 + round_share * harder), a, b)


def state_at_pressure(rubber: Rubber, p_star: float) -> TubeState:
    """Return the state of a long tube at a pressure p* (Pa) from the Maxwell pressure on.

    Raises:
        ValueError: the rubber has no bulged phase.
    """
    hardening = _hardening(rubber)
    a, b = (float(np.interp(p_star, hardening.p_star, values)) for values in hardening[:2])
    return TubeState(p_star, a, b)


def state_at_stretch(rubber: Rubber, a: float) -> TubeState:
    """Return the state of a long tube at a hoop stretch from that of the bulged phase on.

    Raises:
        ValueError: the rubber has no bulged phase.
    """
    hardening = _hardening(rubber)
    b, p_star = (float(np.interp(a, hardening.a, values)) for values in hardening[1:])
    return TubeState(p_star, a, b)


@lru_cache(maxsize=32)
def _hardening(rubber: Rubber) -> _Hardening:
    a = np.linspace(maxwell_state(rubber).bulged.a, LARGEST_STRETCH, _NODES)
    b = closed_tube_axial_stretch(rubber, a)
    return _Hardening(a, b, fixed_length_tube_pressure(rubber, a, b))


def _ends(rubber: Rubber, rest_length: float) -> tuple[float, float]:
    """Return what both ends of a tube of this unstressed length (R0) lack, in what those of a long one do,
    and by how much it is harder, in the pressure of that.
    """
    lengths, lacking, harder = _bursting(rubber)
    return float(np.interp(rest_length, lengths, lacking)), float(np.interp(rest_length, lengths, harder))


@lru_cache(maxsize=32)
def _bursting(rubber: Rubber) -> tuple[Floats, Floats, Floats]:
    """Return unstressed lengths (R0) of tubes about to burst, ascending, what both their ends lack, and by
    how much they are harder.
    """
    tube = closed_tube_state(rubber, BURST_STRETCH)
    law = UnloadedRubber(rubber, float(rubber.energy(tube.a, tube.b)))
    widest, slow = np.full(len(_HARDER), tube.a), 1.0 + _HARDER[0]
    rest, _, volume = bubble_at_stretch(law, (1.0 + _HARDER) * tube.p_star, widest, slow * tube.a)[:, ::-1]
    lacking = math.pi * rest * tube.volume_ratio - volume
    return rest, lacking / lacking[-1], (_HARDER - _HARDER[0])[::-1]
