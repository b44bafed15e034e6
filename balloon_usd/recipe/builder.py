"""Write a recipe in Python, as a chain of steps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self

from balloon_usd.language.choices import unknown
from balloon_usd.language.quantities import METRES, LengthLike, Units, written_length
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.table import BY_WORD, WORDS

from .kosaka import kosaka_entries
from .operation_methods import require_arguments, with_operations
from .recipe import Recipe
from .writer import Entries, recipe_text, step_entries

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from balloon_usd.operations.moves import Pose
    from balloon_usd.operations.tempo import Tempo

    from .balloons import FinishName

BUILDER_FILE = "<builder>"


@with_operations
class RecipeBuilder:
    """Collects balloons and steps; `build` checks them as a file is checked.

    Every operation of the recipe language is a method with the same word. Lengths are in metres, angles in
    degrees, times in seconds. Modifiers (balloon, point, turns, burp, spin, disc, strokes, seconds, note) are
    those of the language.
    """

    def __init__(
        self,
        name: str,
        *,
        title: str = "",
        source: str = "",
        units: Units = "cm",
        fps: float | None = None,
        tempo: Tempo | None = None,
        pose: Pose | None = None,
        height: LengthLike | None = None,
        speed: float | None = None,
        front: str | Sequence[str] | None = None,
        top: str | Sequence[str] | None = None,
        symmetric: bool = True,
        mirror: bool = False,
        must_hold: str | Sequence[str] | None = None,
    ) -> None:
        if units not in METRES:
            raise ValueError(unknown("unit", units, METRES))
        self._units = units
        head = {"title": title or None, "source": source or None, "units": units, "fps": fps, "tempo": tempo}
        self._head = _given(head)
        self._name = name
        self._balloons: dict[str, Entries] = {}
        self._steps: list[Entries] = []
        falling = {"height": None if height is None else self._length(height), "speed": speed}
        self._end = _given({"pose": pose, **falling, "front": _listed(front), "top": _listed(top)})
        self._end |= _given({"symmetric": None if symmetric else False, "mirror": mirror or None})
        self._end |= _given({"must_hold": _listed(must_hold)})
        self._physics: Entries = {}

    def balloon(
        self,
        name: str,
        *,
        size: str | int | None = None,
        mesh: str | None = None,
        color: str | Sequence[float] | None = None,
        finish: FinishName | None = None,
        tail: LengthLike | None = None,
        inflated: LengthLike | None = None,
        filled: float | str | None = None,
        overblown: LengthLike | None = None,
        capsule: LengthLike | None = None,
        radius: LengthLike | None = None,
        length: LengthLike | None = None,
        thickness: LengthLike | None = None,
        unit: Units | None = None,
        swell: float | None = None,
        at: Sequence[LengthLike] | None = None,
    ) -> Self:
        """Take a balloon of a size; give `tail` (flat), `inflated` or `capsule`, m, or `filled`, percent. Or
        take one of a `mesh` file, in this `unit`, blown up to `swell`, its origin `at` a place (3,), m.

        Raises:
            ValueError: there is a balloon of this name.
        """
        if name in self._balloons:
            raise ValueError(f'there is a balloon "{name}" already, expected another name')
        lengths = {
            "tail": tail,
            "inflated": inflated,
            "overblown": overblown,
            "capsule": capsule,
            "radius": radius,
            "length": length,
            "thickness": thickness,
        }
        code = int(size) if isinstance(size, str) and size.isdecimal() else size
        written = {key: self._length(value) for key, value in lengths.items() if value is not None}
        place = None if at is None else [self._length(value) for value in at]
        shape = {"mesh": mesh, "unit": unit, "swell": swell, "at": place}
        self._balloons[name] = (
            _given({"size": code, **shape, "color": color, "finish": finish, "filled": filled}) | written
        )
        return self

    def add(self, step: str | Operation, /, *what: Any, **keys: Any) -> Self:
        """Add a step: one that is there, or the word of an operation with the arguments of its method.

        Raises:
            ValueError: no operation has this word, with the nearest that one has.
            TypeError: the operation has no such arguments, with those that it has.
        """
        if isinstance(step, Operation):
            if what or keys:
                raise TypeError("a whole step takes no arguments")
            self._steps.append(step_entries(step, self._units))
            return self
        if step not in BY_WORD:
            raise ValueError(unknown("operation", step, WORDS))
        operation = BY_WORD[step]
        require_arguments(operation, *what, **keys)
        beside = {key: keys.pop(key) for key in operation.modifiers() if key in keys}
        self._steps.append({step: operation.value_of(self._units, *what, **keys)} | _given(beside))
        return self

    if TYPE_CHECKING:

        def __getattr__(self, word: str) -> Callable[..., Self]:
            """Return the method of an operation."""

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
        entries |= {"steps": self._steps, **self._end} | ({"physics": self._physics} if self._physics else {})
        return recipe_text(entries)

    def build(self) -> Recipe:
        """Check the recipe and return it.

        Raises:
            RecipeError: with all problems, at their places in the text of `to_yaml`.
        """
        return Recipe.parse(self.to_yaml(), file=BUILDER_FILE)

    def _length(self, value: LengthLike) -> object:
        return written_length(value, self._units)


def _given(entries: Mapping[str, object]) -> Entries:
    return {key: value for key, value in entries.items() if value is not None}


def _listed(value: str | Sequence[str] | None) -> object:
    """Return a word, or a list of names, as it stands in a file."""
    return value if value is None or isinstance(value, str) else list(value)
