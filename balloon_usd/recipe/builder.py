"""Write a recipe in Python, as a chain of steps."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, Self

from balloon_usd.language.quantities import Units, length_entry

from .kosaka import kosaka_entries
from .recipe import Recipe
from .writer import Entries, recipe_text

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from balloon_usd.operations.modifiers import Point

LengthLike = float | str
"""Metres, or a text with its own unit such as "4 in"."""

BUILDER_FILE = "<builder>"


class RecipeBuilder:
    """Collects balloons and steps; `build` checks them as a file is checked.

    Lengths are in metres, angles in degrees, times in seconds. The words that follow the bubbles (balloon,
    point, turns, seconds, note) are those of the recipe language.
    """

    def __init__(
        self,
        name: str,
        *,
        title: str = "",
        source: str = "",
        units: Units = "cm",
        fps: float | None = None,
    ) -> None:
        self._units = units
        self._head = _given({"title": title or None, "source": source or None, "units": units, "fps": fps})
        self._name = name
        self._balloons: dict[str, Entries] = {}
        self._steps: list[Entries] = []
        self._physics: Entries = {}

    def balloon(
        self,
        name: str,
        *,
        size: str | int | None = None,
        mesh: str | None = None,
        color: str | Sequence[float] | None = None,
        tail: LengthLike | None = None,
        inflated: LengthLike | None = None,
        capsule: LengthLike | None = None,
        radius: LengthLike | None = None,
        length: LengthLike | None = None,
        thickness: LengthLike | None = None,
        unit: Units | None = None,
        swell: float | None = None,
        at: Sequence[LengthLike] | None = None,
    ) -> Self:
        """Take a balloon of a size; give `tail` (flat), `inflated` or `capsule`, m. Or take one of a `mesh`
        file, in this `unit`, blown up to `swell`, its origin `at` a place (3,), m.
        """
        lengths = {
            "tail": tail,
            "inflated": inflated,
            "capsule": capsule,
            "radius": radius,
            "length": length,
            "thickness": thickness,
        }
        code = int(size) if isinstance(size, str) and size.isdecimal() else size
        written = {key: self._length(value) for key, value in lengths.items() if value is not None}
        place = None if at is None else [self._length(value) for value in at]
        shape = {"mesh": mesh, "unit": unit, "swell": swell, "at": place}
        self._balloons[name] = _given({"size": code, **shape, "color": color}) | written
        return self

    def bubbles(
        self,
        lengths: Mapping[str, LengthLike] | None = None,
        /,
        *,
        balloon: str | None = None,
        turns: float | None = None,
        seconds: float | None = None,
        note: str | None = None,
        **more: LengthLike,
    ) -> Self:
        """Twist off bubbles (inflated lengths, m), one after another."""
        manner = {"balloon": balloon, "turns": turns, "seconds": seconds, "note": note}
        return self._make("bubbles", {**(lengths or {}), **more}, manner)

    def lock(
        self,
        *bubbles: str,
        joints: Sequence[str] | None = None,
        point: Point | None = None,
        balloon: str | None = None,
        turns: float | None = None,
        seconds: float | None = None,
        note: str | None = None,
    ) -> Self:
        """Lock neighbouring bubbles, or joints such as "nose.end"."""
        what: object = list(bubbles) if joints is None else {"joints": list(joints)}
        manner = {"point": point, "balloon": balloon, "turns": turns, "seconds": seconds, "note": note}
        return self._step("lock", what, manner)

    def loop(
        self,
        lengths: Mapping[str, LengthLike] | None = None,
        /,
        *,
        point: Point | None = None,
        balloon: str | None = None,
        turns: float | None = None,
        seconds: float | None = None,
        note: str | None = None,
        **more: LengthLike,
    ) -> Self:
        """Make long bubbles (m), each with its two ends twisted together."""
        manner = {"point": point, "balloon": balloon, "turns": turns, "seconds": seconds, "note": note}
        return self._make("loop", {**(lengths or {}), **more}, manner)

    def fold(
        self,
        lengths: Mapping[str, LengthLike] | None = None,
        /,
        *,
        point: Point | None = None,
        balloon: str | None = None,
        turns: float | None = None,
        seconds: float | None = None,
        note: str | None = None,
        **more: LengthLike,
    ) -> Self:
        """Make bubbles (m) folded in their middle, with their two ends twisted together."""
        manner = {"point": point, "balloon": balloon, "turns": turns, "seconds": seconds, "note": note}
        return self._make("fold", {**(lengths or {}), **more}, manner)

    def ear(
        self,
        lengths: Mapping[str, LengthLike] | None = None,
        /,
        *,
        point: Point | None = None,
        balloon: str | None = None,
        turns: float | None = None,
        seconds: float | None = None,
        note: str | None = None,
        **more: LengthLike,
    ) -> Self:
        """Make short soft bubbles (m), each pinched sideways with its two ends twisted together."""
        manner = {"point": point, "balloon": balloon, "turns": turns, "seconds": seconds, "note": note}
        return self._make("ear", {**(lengths or {}), **more}, manner)

    def rest(
        self, name: str, *, balloon: str | None = None, seconds: float | None = None, note: str | None = None
    ) -> Self:
        """Name what is left of the balloon."""
        return self._step("rest", name, {"balloon": balloon, "seconds": seconds, "note": note})

    def bend(
        self,
        angles: Mapping[str, float | str] | None = None,
        /,
        *,
        point: Point | None = None,
        balloon: str | None = None,
        seconds: float | None = None,
        note: str | None = None,
        **more: float | str,
    ) -> Self:
        """Bend bubbles (degrees), their ends towards `point`."""
        manner = {"point": point, "balloon": balloon, "seconds": seconds, "note": note}
        return self._step("bend", {**(angles or {}), **more}, manner)

    def press(
        self,
        bubble: str,
        *,
        at: LengthLike | None = None,
        depth: LengthLike | None = None,
        force: float | str | None = None,
        point: Point | None = None,
        balloon: str | None = None,
        seconds: float | None = None,
        note: str | None = None,
    ) -> Self:
        """Press a finger into a bubble at a distance from its start, so deep (m) or so hard (N)."""
        lengths = {"at": at, "depth": depth}
        what: Entries = {"bubble": bubble}
        what |= {key: self._length(value) for key, value in lengths.items() if value is not None}
        manner = {"point": point, "balloon": balloon, "seconds": seconds, "note": note}
        return self._step("press", what | _given({"force": force}), manner)

    def push(self, bubble: str, **more: Any) -> Self:
        """Press a finger into a bubble: the older name of `press`."""
        warnings.warn("push is called press now", DeprecationWarning, stacklevel=2)
        return self.press(bubble, **more)

    def wait(self, seconds: float, *, note: str | None = None) -> Self:
        """Do nothing for some seconds."""
        return self._step("wait", seconds, {"note": note})

    def physics(
        self,
        *,
        kosaka: Mapping[str, LengthLike] | None = None,
        **settings: str | float | bool,
    ) -> Self:
        """Set entries of the physics block; lengths among the constants of `kosaka` in m."""
        self._physics |= settings
        if kosaka is not None:
            self._physics["kosaka"] = kosaka_entries(kosaka, self._units)
        return self

    def to_yaml(self) -> str:
        """Write what was collected as YAML text, right or wrong."""
        entries: Entries = {"format": 1, "name": self._name, **self._head, "balloons": self._balloons}
        entries |= {"steps": self._steps} | ({"physics": self._physics} if self._physics else {})
        return recipe_text(entries)

    def build(self) -> Recipe:
        """Check the recipe and return it.

        Raises:
            RecipeError: with all problems, at their places in the text of `to_yaml`.
        """
        return Recipe.parse(self.to_yaml(), file=BUILDER_FILE)

    def _make(self, kind: str, lengths: Mapping[str, LengthLike], manner: Mapping[str, object]) -> Self:
        return self._step(kind, {name: self._length(value) for name, value in lengths.items()}, manner)

    def _step(self, kind: str, what: object, manner: Mapping[str, object]) -> Self:
        self._steps.append({kind: what} | _given(manner))
        return self

    def _length(self, value: LengthLike) -> object:
        return value if isinstance(value, str) else length_entry(float(value), self._units)


def _given(entries: Mapping[str, object]) -> Entries:
    return {key: value for key, value in entries.items() if value is not None}
