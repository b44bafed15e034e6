"""Why variations are not made."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.language.problem import PROBLEMS_SHOWN

if TYPE_CHECKING:
    from collections.abc import Iterable


class VariationError(ValueError):
    """Variations that cannot be made; `problems` holds all reasons, each on a line of its own."""

    def __init__(self, problems: Iterable[str]) -> None:
        self.problems: tuple[str, ...] = tuple(dict.fromkeys(problems))
        super().__init__(self.problems)

    def __str__(self) -> str:
        """One line for each problem."""
        lines = list(self.problems[:PROBLEMS_SHOWN])
        hidden = len(self.problems) - len(lines)
        return "\n".join([*lines, f"{hidden} more problems"] if hidden > 0 else lines)


class VariationNotWrittenError(VariationError):
    """Variations that are fine and could not be written, as on a full disk; none of them is left."""
