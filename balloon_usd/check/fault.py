"""A fault: what is wrong with a stage, who says so, and what to do about it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from balloon_usd.stage.properties import PROPERTIES

if TYPE_CHECKING:
    from balloon_usd.stage.properties import Finding

OURS, USD_CORE, NVIDIA = "balloon_usd", "usd-core", "nvidia"
"""Who finds faults."""


@dataclass(frozen=True)
class Fault:
    """One fault of a stage."""

    by: str
    """Who found it: `balloon_usd`, `usd-core` or `nvidia`."""
    rule: str
    """Number of the property, or the validator's name of its rule."""
    text: str
    """What is wrong, one sentence."""
    prim: str = ""
    """Path of the prim or property; empty for the stage itself."""
    time_code: float | None = None
    """Time code at which it shows; None where that does not matter."""
    remedy: str = ""
    """What to do about it."""
    variants: str = ""
    """Selection of variants in which it shows, such as "look=clay"; empty for the stage's own."""

    @property
    def kind(self) -> tuple[str, str]:
        """What faults are grouped by."""
        return self.by, self.rule

    def at(self, variants: str) -> Fault:
        """The same fault in a selection of variants."""
        return replace(self, variants=variants)


def fault_of(finding: Finding) -> Fault:
    """A finding of a property as a fault."""
    remedy = finding.remedy or PROPERTIES[finding.number].remedy
    return Fault(OURS, str(finding.number), finding.text, finding.prim, finding.time_code, remedy)
