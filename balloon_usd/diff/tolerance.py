"""How far numbers may differ before two stages count as different."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping

_NUMBER = r"\d+(?:\.\d*)?(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?"
_ALLOWED = re.compile(rf"(?:({_NUMBER}))?(?:\s*\+?\s*({_NUMBER})\s*%)?", re.ASCII)
EXPECTED = 'expected a number in the unit of the attribute ("1e-4"), a share ("2%"), or both ("1e-4 + 2%")'


@dataclass(frozen=True)
class Allowed:
    """A difference that is allowed: `absolute`, plus `relative` times the larger of both values."""

    absolute: float = 0.0
    """In the unit of the attribute."""
    relative: float = 0.0
    """As a share."""

    @classmethod
    def parse(cls, text: str) -> Allowed:
        """Read a number, a share such as `2%`, or both joined by `+`.

        Raises:
            ValueError: it is none of these.
        """
        found = _ALLOWED.fullmatch(text.strip())
        if not found or found.groups() == (None, None) or (found[1] and found[2] and "+" not in text):
            raise ValueError(f'"{text}" is no tolerance, {EXPECTED}')
        absolute, percent = (float(part or 0.0) for part in found.groups())
        if not (math.isfinite(absolute) and math.isfinite(percent)):
            raise ValueError(f'"{text}" is too large for a tolerance')
        return cls(absolute, percent / 100.0)


@dataclass(frozen=True)
class Tolerances:
    """What is allowed of every attribute of floats, and of the distance between surfaces."""

    general: Allowed = Allowed()
    """Of attributes that are not named."""
    named: Mapping[str, Allowed] = field(default_factory=dict)
    """By the name of the attribute, with or without its namespace: `primvars:stretch` or `stretch`."""
    rms: float | None = None
    """Distance of a surface's points in one frame, as the root of the mean square, m; None: not looked at."""

    def of(self, name: str) -> Allowed:
        """Return what is allowed of an attribute."""
        return self.named.get(name) or self.named.get(base_name(name)) or self.general

    def unknown_names(self, attributes: Collection[str]) -> Iterable[str]:
        """Say of each name that no attribute has what was probably meant."""
        from balloon_usd.language.choices import unknown  # noqa: PLC0415

        bases = {base_name(name) for name in attributes}
        for name in self.named:
            if name not in attributes and name not in bases:
                yield unknown("attribute", name, sorted({*attributes, *bases}))


def base_name(name: str) -> str:
    """Return a name without its namespace."""
    return name.rpartition(":")[2]


EXACT = Tolerances()
"""Nothing is allowed."""
