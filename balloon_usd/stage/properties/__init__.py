"""What is true of every stage that this package writes, as numbered checks.

Each property is a function that yields a `Finding` for every place where a stage lacks it; the
first line of its docstring is the property. 26 to 28 need other programs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.stage.properties.composition import (
    extents_hint_is_union,
    no_animated_visibility,
    nothing_undefined,
    one_component_root,
    only_relative_paths,
    opens_whole,
    plausible_size,
    provenance_complete,
    rates_agree,
    units_and_times_authored,
)
from balloon_usd.stage.properties.files import flat_equals_composed, same_bytes, whole_or_absent
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.looks import (
    bubbles_partition,
    color_and_sides_authored,
    materials_bound,
    points_and_nesting,
    primvars_fit,
)
from balloon_usd.stage.properties.surface import (
    all_finite,
    closed_surface,
    extents_tight,
    subdivision_authored,
    topology_valid,
)
from balloon_usd.stage.properties.timing import (
    default_is_last,
    no_teleport,
    one_sample_per_time_code,
    static_topology,
    velocities_true,
)
from balloon_usd.stage.properties.variants import every_selection

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

PROPERTIES: dict[int, Callable[[Any], Iterator[Finding]]] = {
    1: opens_whole,
    2: one_component_root,
    3: units_and_times_authored,
    4: rates_agree,
    5: one_sample_per_time_code,
    6: only_relative_paths,
    7: nothing_undefined,
    8: plausible_size,
    9: provenance_complete,
    10: extents_hint_is_union,
    11: no_animated_visibility,
    12: topology_valid,
    13: all_finite,
    14: extents_tight,
    15: closed_surface,
    16: subdivision_authored,
    17: static_topology,
    18: velocities_true,
    19: no_teleport,
    20: primvars_fit,
    21: bubbles_partition,
    22: materials_bound,
    23: points_and_nesting,
    24: default_is_last,
    25: color_and_sides_authored,
}
"""Properties of one open stage, by number."""


def check_stage(stage: Any) -> list[Finding]:
    """Every finding of every property of one stage, in order of the numbers."""
    return [finding for check in PROPERTIES.values() for finding in check(stage)]


def check_variants(stage: Any) -> list[Finding]:
    """Every finding of one stage under every selection of its variants."""
    return list(every_selection(stage, check_stage))


__all__ = [
    "PROPERTIES",
    "Finding",
    "check_stage",
    "check_variants",
    "flat_equals_composed",
    "one_sample_per_time_code",
    "opens_whole",
    "same_bytes",
    "whole_or_absent",
]
