"""What is true of every stage that this package writes, as numbered checks.

`PROPERTIES` says what each of the 32 means, for which stages it holds and where it is tested. Those that
can be seen on an open stage are functions that yield a `Finding` for every place where it is not true: of
the stage, of each value of each attribute, or of each mesh at each sample of its points.
"""

from __future__ import annotations

from balloon_usd.stage.properties.checking import (
    Selected,
    check_property,
    check_selections,
    check_stage,
    check_variants,
)
from balloon_usd.stage.properties.composition import opens_whole
from balloon_usd.stage.properties.files import same_bytes, whole_or_absent
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.kinds import StageKind, kind_of
from balloon_usd.stage.properties.table import PROPERTIES, Property
from balloon_usd.stage.properties.timing import one_sample_per_time_code
from balloon_usd.stage.properties.variants import Selection

__all__ = [
    "PROPERTIES",
    "Finding",
    "Property",
    "Selected",
    "Selection",
    "StageKind",
    "check_property",
    "check_selections",
    "check_stage",
    "check_variants",
    "kind_of",
    "one_sample_per_time_code",
    "opens_whole",
    "same_bytes",
    "whole_or_absent",
]
