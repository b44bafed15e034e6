"""The physical models, and in what they differ for those who plan, tell and draw."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from balloon_usd.balloon.rubber import BURST_STRETCH

ModelName = Literal["latex", "kosaka"]


@dataclass(frozen=True)
class ModelTraits:
    """What is true of all figures of a physical model."""

    version: str
    """Name and number in the provenance of results: another number may move points."""
    title: str
    """What it is made of, in a few words."""
    has_weight: bool
    """Whether the finished figure has its true weight, and falls."""
    winds: bool
    """Whether joints are wound by turns, and so can unwind; else they freeze."""
    starts_blown_up: bool
    """Whether balloons are blown up before the first frame."""
    has_air_particles: bool
    """Whether its air is made of particles, which a stage can show."""
    highest_stretch: float
    """Where the colours of stretch end."""
    burst_stretch: float | None
    """Stretch beyond which a wall bursts; None where it never does."""


MODELS: dict[ModelName, ModelTraits] = {
    "latex": ModelTraits(
        version="latex 35",
        title="hyperelastic rubber and gas",
        has_weight=True,
        winds=True,
        starts_blown_up=False,
        has_air_particles=False,
        highest_stretch=BURST_STRETCH,
        burst_stretch=BURST_STRETCH,
    ),
    "kosaka": ModelTraits(
        version="kosaka 4",
        title="springs and air particles",
        has_weight=False,
        winds=False,
        starts_blown_up=True,
        has_air_particles=True,
        # Springs stand at twice their natural length and rarely reach three times.
        highest_stretch=3.0,
        burst_stretch=None,
    ),
}
"""Physical models by the names that recipes give them."""
