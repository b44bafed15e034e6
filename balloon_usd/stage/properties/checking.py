"""A stage, looked at by every property that can be seen on it, in one selection of variants or in all."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from balloon_usd.openusd import each_step_alone, usd_access
from balloon_usd.stage.properties.finding import Finding
from balloon_usd.stage.properties.kinds import kind_of
from balloon_usd.stage.properties.samples import look_at_samples
from balloon_usd.stage.properties.table import PROPERTIES, properties_of
from balloon_usd.stage.properties.variants import missing_variants, selections

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.stage.properties.reading import Opinions
    from balloon_usd.stage.properties.table import Property
    from balloon_usd.stage.properties.variants import Selection


@usd_access()
def check_property(number: int, stage: Any) -> list[Finding]:
    """Every finding of one property of one stage."""
    return _findings(stage, {number: PROPERTIES[number]}, set())


@usd_access()
def check_stage(stage: Any) -> list[Finding]:
    """Every finding of every property of one stage, in order of the numbers."""
    return _findings(stage, properties_of(kind_of(stage)), set())


class Selected(NamedTuple):
    """A stage in one selection of its variants."""

    selection: Selection
    stage: Any
    """So selected until the next one is asked for."""
    findings: list[Finding]
    """What was not found in an earlier selection, where that has the same values."""


@each_step_alone
def check_selections(stage: Any) -> Iterator[Selected]:
    """Every selection of the variants with its findings; its own comes first, and values are looked at once.

    The variants in a shot are those of the shot itself: its sculptures have stages of their own.
    """
    properties = properties_of(kind_of(stage))
    seen: set[Opinions] = set()
    for selection, selected in selections(stage):
        findings = [*_findings(selected, properties, seen), *missing_variants(selected)]
        yield Selected(selection, selected, findings)


@usd_access()
def check_variants(stage: Any) -> list[Finding]:
    """Every finding of one stage under every selection of its variants, as findings of property 32."""
    return [
        finding
        if finding.number == 32
        else Finding(32, f"{', '.join(selected.selection.values())}: {finding}")
        for selected in check_selections(stage)
        for finding in selected.findings
    ]


def _findings(stage: Any, properties: dict[int, Property], seen: set[Opinions]) -> list[Finding]:
    found = [finding for told in properties.values() for look in told.of_stage for finding in look(stage)]
    of_values = [look for told in properties.values() for look in told.of_values]
    at_moments = [look for told in properties.values() for look in told.at_moments]
    if of_values or at_moments:
        found += look_at_samples(stage, of_values, at_moments, seen)
    return sorted(found, key=lambda finding: finding.number)
