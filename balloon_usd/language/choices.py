"""Say what was expected when a word is not one of the known ones."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING

from balloon_usd.language.problem import printable, quoted

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

_WORD_COMPARED = 64
_CHOICES_COMPARED = 1000
_CHOICES_LISTED = 32
"""As many as there are operations, and some."""
_ALIKE = 0.6
"""Share of letters in common from which a word counts as a slip of the pen (difflib's own default)."""


def nearest(word: str, choices: Sequence[str]) -> str | None:
    """Find the choice that was probably meant, or None."""
    if len(word) > _WORD_COMPARED:
        return None
    by_lower_case = {choice.lower(): choice for choice in choices[:_CHOICES_COMPARED]}
    found = difflib.get_close_matches(word.lower(), by_lower_case, n=1, cutoff=_ALIKE)
    return by_lower_case[found[0]] if found else None


def one_of(choices: Iterable[str]) -> str:
    """List the choices: `one of up, down, left`."""
    listed = [printable(choice) for choice in choices]
    if len(listed) == 1:
        return listed[0]
    more = len(listed) - _CHOICES_LISTED
    end = f" and {more} more" if more > 0 else ""
    return "one of " + ", ".join(listed[:_CHOICES_LISTED]) + end


def all_of(names: Sequence[str]) -> str:
    """List one or more names: `left, right and tail`."""
    *others, last = names
    return f"{', '.join(others)} and {last}" if others else last


def unknown(what: str, word: object, choices: Iterable[str]) -> str:
    """Compose `unknown bubble "lft_ear", did you mean "left_ear"?`, or list what is known."""
    known = list(choices)
    begin = f"unknown {what} {quoted(word)}"
    guess = nearest(word, known) if isinstance(word, str) else None
    if guess is not None:
        return f"{begin}, did you mean {quoted(guess)}?"
    if not known:
        return f"{begin}, there is none yet"
    return f"{begin}, expected {one_of(known)}"
