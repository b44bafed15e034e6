"""Balloon sizes: the flat, unstressed wall of each code, of tubes, round balloons and hearts.

No published measurement of these tubes was found. Radii and lengths are the nominal inflated sizes (the
first digit is the diameter in inches, the rest the length in inches) divided by the stretches at which latex
carries its bulge (5.664 round the tube, 4.146 along it, see `tube_theory.maxwell_state`); the wall thickness
is chosen to give a plausible weight. Uncertainty: radius 15 %, length 20 %, thickness 30 %.

Round balloons are as wide as their names say, in inches, when their widest ring is stretched five times.
Their walls are as thick as their weights need: 2.7 g were measured of one of 10.5 inches, and 0.5 to 0.6 g
are told of one of 5. Their necks are judged. Uncertainty: radius 10 %, neck and thickness 30 %. Hearts are as
wide as their names say when they are four times as wide as flat; their walls are judged, 30 %.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace

from balloon_usd.balloon.heart_surface import HeartSurface, heart_surface
from balloon_usd.balloon.round_outline import round_area, round_length

NECK_REACH = 1.0
"""Rubber on each side of a joint that counts as its neck, in R0: folded and pressed together there."""


@dataclass(frozen=True)
class BalloonSize:
    """The unstressed tube, or round balloon, of one balloon size.

    Raises:
        ValueError: a dimension is not a positive finite number.
    """

    name: str
    """Size code, for example "260"."""
    radius: float
    """Unstressed tube radius R0, or that of the widest ring of a round balloon, m."""
    length: float
    """Unstressed length L0 from the knot to the tip along the wall, m."""
    thickness: float
    """Unstressed wall thickness h0, m."""
    neck: float | None = None
    """Unstressed radius at the knot of a round balloon, m; None of a tube, which is as wide everywhere."""
    heart: bool = False
    """Whether a round balloon has two lobes: its radius is half of its width then."""

    def __post_init__(self) -> None:
        for field in fields(self)[1:]:
            value = getattr(self, field.name)
            if value is not None and value is not False and not (math.isfinite(value) and value > 0.0):
                raise ValueError(
                    f"balloon {self.name}: {field.name} must be positive and finite, got {value}"
                )

    @classmethod
    def round(cls, name: str, radius: float, neck: float, thickness: float) -> BalloonSize:
        """Return a round balloon with a widest ring and a neck of some radii, m."""
        return cls(name, radius, round_length(radius, neck), thickness, neck)

    @property
    def neck_radius(self) -> float:
        """Unstressed radius at the knot, m."""
        return self.radius if self.neck is None else self.neck

    @property
    def heart_wall(self) -> HeartSurface:
        """The unstressed wall of a heart: computed when it is first asked for, 5 ms."""
        return heart_surface(self.radius, self.neck_radius)

    @property
    def flat_width(self) -> float:
        """Width of the empty tube pressed flat, m."""
        return math.pi * self.radius

    @property
    def rubber_volume(self) -> float:
        """Volume of the rubber itself, m3."""
        if self.heart:
            return self.thickness * self.heart_wall.area
        if self.neck is not None:
            return self.thickness * round_area(self.radius, self.neck)
        return 2.0 * math.pi * self.radius * self.thickness * self.length

    def with_overrides(
        self,
        radius: float | None = None,
        length: float | None = None,
        thickness: float | None = None,
    ) -> BalloonSize:
        """Return this size with the given unstressed dimensions (m) instead of its own; a round balloon of
        another radius is as long and has as wide a neck in proportion.

        Raises:
            ValueError: a given dimension is not a positive finite number.
        """
        if self.neck is not None:
            scale = 1.0 if radius is None else radius / self.radius
            wall = self.thickness if thickness is None else thickness
            return replace(
                self,
                radius=scale * self.radius,
                length=scale * self.length,
                thickness=wall,
                neck=scale * self.neck,
            )
        return BalloonSize(
            self.name,
            radius=self.radius if radius is None else radius,
            length=self.length if length is None else length,
            thickness=self.thickness if thickness is None else thickness,
        )


SIZES: tuple[BalloonSize, ...] = (
    BalloonSize("160", radius=2.24e-3, length=0.368, thickness=0.18e-3),
    BalloonSize("260", radius=4.50e-3, length=0.367, thickness=0.18e-3),
    BalloonSize("321", radius=6.73e-3, length=0.129, thickness=0.20e-3),
    BalloonSize("350", radius=6.73e-3, length=0.306, thickness=0.20e-3),
    BalloonSize("360", radius=6.73e-3, length=0.368, thickness=0.20e-3),
    BalloonSize("646", radius=13.5e-3, length=0.282, thickness=0.25e-3),
    BalloonSize.round("R5", radius=13.0e-3, neck=6.0e-3, thickness=0.16e-3),
    BalloonSize.round("R11", radius=28.0e-3, neck=9.0e-3, thickness=0.17e-3),
    # As long as their walls are in the mean, which every start of a command would take 12 ms to find.
    BalloonSize("H6", radius=18.6e-3, length=46.25114e-3, thickness=0.13e-3, neck=6.8e-3, heart=True),
    BalloonSize("H11", radius=34.2e-3, length=85.04297e-3, thickness=0.14e-3, neck=12.5e-3, heart=True),
)
"""Every size that a recipe can name."""

_SIZES_BY_NAME = {size.name: size for size in SIZES}


def size_named(name: str) -> BalloonSize:
    """Return the balloon size with this code.

    Raises:
        ValueError: no such size.
    """
    try:
        return _SIZES_BY_NAME[name]
    except KeyError:
        raise ValueError(
            f"unknown balloon size {name!r}, expected one of {', '.join(_SIZES_BY_NAME)}"
        ) from None
