"""What was found out about one stage."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from balloon_usd.stage.properties import StageKind

if TYPE_CHECKING:
    from balloon_usd.check.fault import Fault


@dataclass
class Report:
    """The faults of one stage, and what was looked at."""

    stage: str
    """The stage as it was named."""
    asks_nvidia: bool = False
    """Whether NVIDIA's validator is asked."""
    misses_nvidia: bool = False
    """Whether it would be asked, but is not installed."""
    kind: StageKind = StageKind.ASSET
    unreadable: str = ""
    """Why it cannot be read, in one line; empty if it can."""
    faults: dict[Fault, Fault] = field(default_factory=dict)
    """Each fault once, by what it is apart from the variants, in the order in which they were found."""
    selections: list[str] = field(default_factory=list)
    """Selections of variants that were looked at."""
    left_out: bool = False
    """Whether there are more selections, which were not looked at."""
    frames: list[float] = field(default_factory=list)
    """Time codes that were frozen for the validators, of the stage's own selection."""
    validators: list[str] = field(default_factory=list)
    """Who was asked besides this package."""
    not_counted: Counter[str] = field(default_factory=Counter)
    """What validators said that is no fault, with how often, by the reason."""

    def add(self, fault: Fault, variants: str) -> None:
        """Take a fault that was not found in another selection of variants before."""
        self.faults.setdefault(fault.at(""), fault.at(variants))

    @property
    def found(self) -> list[Fault]:
        """The faults: the properties' by number, then those of each validator by the name of its rule."""
        return sorted(self.faults.values(), key=lambda fault: (not fault.rule.isdigit(), _order(fault)))


def _order(fault: Fault) -> tuple[int, str, str]:
    return (int(fault.rule) if fault.rule.isdigit() else 0, fault.by, fault.rule)
