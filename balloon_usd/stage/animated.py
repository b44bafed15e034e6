"""The attributes that move, one table for their time samples and their resting values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np

from balloon_usd.openusd import Sdf, Vt
from balloon_usd.stage.cluster_color import colors_of
from balloon_usd.stage.provenance import KEY
from balloon_usd.stage.stretch_color import stretch_colors, stretch_shades

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from balloon_usd.stage.pose import AirPose, MeshPose, Pose

STEP = f"{KEY}:step"
"""String on the root prim: what the hands do, sampled where a step of the recipe begins."""
BUBBLES = f"{KEY}:bubbles"
"""Tokens on the root prim: names of the bubbles, which all numbers of bubbles count in."""

P = TypeVar("P")


@dataclass(frozen=True)
class Animated(Generic[P]):
    """An attribute, its value type and how its value is read from a pose or a part of it."""

    name: str
    type_name: Any
    read: Callable[[P], Any]
    documentation: str = ""
    blends: bool = False
    """Whether readers blend between samples what should jump."""


def _vectors(values: Any) -> Any:
    return Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(values))


def _floats(values: Any) -> Any:
    return Vt.FloatArray.FromNumpy(np.ascontiguousarray(values))


def _integers(values: Any) -> Any:
    return Vt.IntArray.FromNumpy(np.ascontiguousarray(values))


ON_MESH: tuple[Animated[MeshPose], ...] = (
    Animated("points", Sdf.ValueTypeNames.Point3fArray, lambda pose: _vectors(pose.points)),
    Animated("extent", Sdf.ValueTypeNames.Float3Array, lambda pose: _vectors(pose.extent)),
    Animated(
        "primvars:stretch",
        Sdf.ValueTypeNames.FloatArray,
        lambda pose: _floats(pose.stretch),
        "Largest principal stretch of the rubber at each vertex, 1 where it is flat.",
    ),
    Animated(
        "primvars:pressure",
        Sdf.ValueTypeNames.FloatArray,
        lambda pose: _floats(pose.pressure),
        "Gauge pressure at each vertex, Pa: that of its bubble.",
    ),
)

ON_AIR: tuple[Animated[AirPose], ...] = (
    Animated("points", Sdf.ValueTypeNames.Point3fArray, lambda pose: _vectors(pose.points)),
    Animated("extent", Sdf.ValueTypeNames.Float3Array, lambda pose: _vectors(pose.extent)),
)

BY_CLUSTER: tuple[Animated[NDArray[np.int32]], ...] = (
    Animated("primvars:cluster", Sdf.ValueTypeNames.IntArray, _integers),
    Animated(
        "primvars:displayColor",
        Sdf.ValueTypeNames.Color3fArray,
        lambda cluster: _vectors(colors_of(cluster)),
        blends=True,
    ),
)
"""What changes with the clusters (P,) of the air, which is seldom: sampled only then."""


def colors_of_stress(highest: float) -> Animated[MeshPose]:
    """Stretch as a colour of the ramp that ends at the highest stretch."""
    return Animated(
        "primvars:displayColor",
        Sdf.ValueTypeNames.Color3fArray,
        lambda pose: _vectors(stretch_colors(pose.stretch, highest)),
    )


def shades_of_stress(highest: float) -> Animated[MeshPose]:
    """Stretch as the number of a colour of that ramp."""
    return Animated(
        "primvars:displayColor:indices",
        Sdf.ValueTypeNames.IntArray,
        lambda pose: _integers(stretch_shades(pose.stretch, highest)),
    )


ON_ROOT: tuple[Animated[Pose], ...] = (
    Animated(
        f"{KEY}:pressure",
        Sdf.ValueTypeNames.FloatArray,
        lambda pose: _floats(pose.pressure),
        f"Gauge pressure of each bubble, Pa, in the order of {BUBBLES}.",
    ),
    Animated(
        f"{KEY}:volume",
        Sdf.ValueTypeNames.FloatArray,
        lambda pose: _floats(pose.volume),
        f"Gas volume of each bubble, m3, in the order of {BUBBLES}.",
    ),
)
