"""Which combinations of values are made: all of them, or some drawn at random.

A combination is the number of a value, from 0, for each parameter.
"""

from __future__ import annotations

import random
from itertools import islice, product
from math import prod
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

MOST_VARIATIONS = 100_000
"""Recipes that are made at once."""

Combination = tuple[int, ...]


def sweep(counts: Sequence[int]) -> Iterator[Combination]:
    """Yield all combinations of so many values each; those of the last parameter follow one another."""
    return product(*map(range, counts))


def draw(counts: Sequence[int], number: int, seed: int) -> list[Combination]:
    """Draw combinations; none comes again before all have come.

    Only `random.Random(seed).random()` is used, whose sequence Python promises never to change: a seed gives
    the same combinations everywhere.
    """
    return list(islice(_without_repeats(counts, random.Random(seed)), number))  # noqa: S311  # no secret


def _without_repeats(counts: Sequence[int], numbers: random.Random) -> Iterator[Combination]:
    """Yield combinations for ever."""
    every = prod(counts)
    seen: set[Combination] = set()
    while True:
        drawn = tuple(int(numbers.random() * count) for count in counts)
        if drawn not in seen:
            seen.add(drawn)
            yield drawn
        if len(seen) == every:
            seen.clear()
