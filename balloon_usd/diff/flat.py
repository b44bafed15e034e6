"""Property 31 of a stage: its single layer equals the composed stage."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.diff.comparison import Comparing
from balloon_usd.stage.properties import Finding

if TYPE_CHECKING:
    from collections.abc import Iterator


def flat_equals_composed(flat: Any, composed: Any) -> Iterator[Finding]:
    """Property 31: the single layer equals the composed stage."""
    for difference in Comparing(composed_only=True).differences(flat, composed):
        # Where a point moved is told of its attribute.
        if not difference.movement:
            yield Finding(31, str(difference))
