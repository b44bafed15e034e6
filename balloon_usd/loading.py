"""Loading: what a process does before it imports many modules."""

from __future__ import annotations

import gc

OBJECTS = 100_000
"""Objects between two collections of garbage."""


def expect_modules() -> None:
    """Collect garbage seldom: modules bring thousands of objects, all of which stay, and looking through them
    again and again takes a tenth of the start.
    """
    gc.set_threshold(OBJECTS)
