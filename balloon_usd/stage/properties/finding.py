"""A finding: one place where a stage lacks a property."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Finding:
    """What is wrong, where and when."""

    number: int
    """Number of the property."""
    text: str
    """One sentence."""
    prim: str = ""
    """Path of the prim or property; empty for the stage itself."""
    time_code: float | None = None
    """Time code of the sample; None for what does not depend on time."""
    remedy: str = ""
    """What to do about it; empty where the table of properties says it."""

    def __str__(self) -> str:
        when = "" if self.time_code is None else f" at time code {self.time_code:g}"
        where = f" {self.prim}{when}:" if self.prim else ""
        return f"property {self.number}:{where} {self.text}"
