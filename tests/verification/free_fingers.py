"""Fingers that press no gas in or out: what bubbles hold is then what theory says, and not what hands see to."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

import pytest

from balloon_usd.solver.latex.motions import closing_neck

if TYPE_CHECKING:
    from collections.abc import Iterator


@contextmanager
def free_fingers() -> Iterator[None]:
    """Let every neck be open to gas until it is closed, and nothing be pressed through it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(closing_neck, "SHUT", 1.0)
        patch.setattr(closing_neck, "LEAST_KEPT", 0.0)
        yield
