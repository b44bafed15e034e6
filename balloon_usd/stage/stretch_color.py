"""The ramp that shows stretch as a colour: blue where rubber is slack, pale half-way, red where it bursts.

Its lightness rises to the middle and falls again, in steps that look alike all along (Oklab,
Ottosson 2020), so that neither end hides anything and a print in grey still tells far from middling.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

LOWEST_STRETCH = 1.0
"""Stretch of the first colour: rubber as it came from the bag."""

STOPS = np.array(
    [
        (0.360, -0.005, -0.145),
        (0.520, -0.027, -0.127),
        (0.680, -0.044, -0.095),
        (0.820, -0.046, -0.046),
        (0.945, -0.010, 0.059),
        (0.840, 0.026, 0.122),
        (0.720, 0.092, 0.131),
        (0.560, 0.149, 0.101),
        (0.390, 0.121, 0.049),
    ]
)
"""Colours evenly along the ramp as lightness, green to red, blue to yellow (Oklab)."""

SHADES = 256
"""Colours of the ramp: neighbours cannot be told apart."""


def _linear_rgb(oklab: NDArray[np.float64]) -> NDArray[np.float64]:
    """Linear rgb (N, 3) of colours in Oklab (N, 3)."""
    to_cones = np.array(
        [
            (1.0, 0.3963377774, 0.2158037573),
            (1.0, -0.1055613458, -0.0638541728),
            (1.0, -0.0894841775, -1.2914855480),
        ]
    )
    to_rgb = np.array(
        [
            (4.0767416621, -3.3077115913, 0.2309699292),
            (-1.2684380046, 2.6097574011, -0.3413193965),
            (-0.0041960863, -0.7034186147, 1.7076147010),
        ]
    )
    cones = (oklab[:, None, :] * to_cones).sum(axis=2) ** 3
    return np.asarray((cones[:, None, :] * to_rgb).sum(axis=2))


def _shades() -> NDArray[np.float32]:
    """The ramp (SHADES, 3), linear rgb."""
    along, places = np.linspace(0.0, 1.0, SHADES), np.linspace(0.0, 1.0, len(STOPS))
    oklab = np.stack([np.interp(along, places, stops) for stops in STOPS.T], axis=1)
    # Rounded, so that the last bit of a processor's arithmetic reaches no file.
    return np.round(np.clip(_linear_rgb(oklab), 0.0, 1.0), 4).astype(np.float32)


RAMP = _shades()


def stretch_shades(stretch: NDArray[np.float32], highest: float) -> NDArray[np.int32]:
    """Number in `RAMP` (V,) int32 of the colour of stretch (V,), from `LOWEST_STRETCH` to `highest`.

    What lies beyond either end has the colour of that end.
    """
    share = (stretch - np.float32(LOWEST_STRETCH)) * np.float32(SHADES / (highest - LOWEST_STRETCH))
    return np.clip(share, 0, SHADES - 1, out=share).astype(np.int32)


def stretch_colors(stretch: NDArray[np.float32], highest: float) -> NDArray[np.float32]:
    """Colour (V, 3), linear rgb, of stretch (V,), see `stretch_shades`."""
    return RAMP.take(stretch_shades(stretch, highest), axis=0)


def ramp_legend(highest: float) -> str:
    """What the colours say, in one sentence."""
    middle = 0.5 * (LOWEST_STRETCH + highest)
    return (
        f"Largest principal stretch as a colour: {LOWEST_STRETCH:g} dark blue, {middle:g} pale yellow, "
        f"{highest:g} dark red."
    )
