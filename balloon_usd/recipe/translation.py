"""Say in the words of a recipe what pydantic found, at the place where it stands."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from balloon_usd.language.choices import one_of, unknown
from balloon_usd.language.problem import PROBLEMS_SHOWN, Complaint, Path, quoted
from balloon_usd.language.quantities import UnitMissingError
from balloon_usd.operations.modifiers import MODIFIERS
from balloon_usd.operations.table import BY_WORD, CALLED, NOT_THERE, WORDS, words_in

from .balloons import Balloon
from .held_words import MUST_HOLD
from .kosaka import Kosaka
from .physics import Physics
from .repeats import LET, REPEAT

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationError
    from pydantic_core import ErrorDetails

_EXPECTED: dict[str, str] = {
    "missing": "is missing",
    "bool_type": "expected true or false",
    "tuple_type": "expected a list such as [left_ear, right_ear]",
    "dict_type": "expected entries such as {nose: 10}",
    "model_type": "expected entries such as key: value",
    "model_attributes_type": "expected entries such as key: value",
    "too_short": "is empty, expected at least one entry",
    "union_tag_not_found": "expected a list of bubbles, or {joints: [nose.end, tail.start]}",
}
_COUNTS = {"too_short": ("at least", "min_length"), "too_long": ("at most", "max_length")}
"""Words for how many entries a list or mapping has, and where pydantic tells the limit."""
_CHOICE = re.compile(r"'([^']*)'|(\d+)")


def validation_complaints(error: ValidationError, data: object, root: type[BaseModel]) -> list[Complaint]:
    """Translate the errors of one validation; `root` is the model of the whole recipe."""
    details = [detail for detail in error.errors(include_url=False) if not _only_seems_empty(detail)]
    unitless = [detail for detail in details if isinstance(_cause(detail), UnitMissingError)]
    repeated = {id(detail) for detail in unitless[1:]}
    shown = [detail for detail in details if id(detail) not in repeated][: PROBLEMS_SHOWN + 1]
    complaints = [_unfit_held(detail) or _complaint(detail, data, root) for detail in shown]
    if len(unitless) > 1:
        at = shown.index(unitless[0])
        more = f" ({len(unitless) - 1} more lengths have none)"
        complaints[at] = Complaint(complaints[at].path, complaints[at].text + more)
    return complaints


def _only_seems_empty(detail: ErrorDetails) -> bool:
    """Pydantic counts valid entries only: a list of wrong ones is too short to it."""
    return detail["type"] == "too_short" and len(detail["input"]) >= detail["ctx"]["min_length"]


def _unfit_held(detail: ErrorDetails) -> Complaint | None:
    """Say what the joints that must hold can be; None of other errors."""
    if detail["loc"][:1] != (MUST_HOLD,) or detail["type"] not in ("union_tag_not_found", "literal_error"):
        return None
    expected = "all, planned, none, or joints such as [nose.end]"
    return Complaint((MUST_HOLD,), f"{quoted(detail['input'])} does not fit, expected {expected}")


def _complaint(detail: ErrorDetails, data: object, root: type[BaseModel]) -> Complaint:
    path = _path(detail["loc"], data)
    kind, value = detail["type"], detail["input"]
    if kind == "missing":
        path = (*path, detail["loc"][-1])
        return Complaint(path, f"is missing, expected {_wanted(path)}")
    if kind == "extra_forbidden":
        return Complaint(path, _unfit_key(path, data) or _unknown_key(path, root))
    if kind == "literal_error":
        return Complaint(path, _unknown_choice(path, value, str(detail["ctx"]["expected"])))
    cause = _cause(detail)
    if cause is not None:
        return Complaint(path, str(cause))
    if kind in _COUNTS and value:
        word, limit = _COUNTS[kind]
        found = "1 entry" if len(value) == 1 else f"{len(value)} entries"
        return Complaint(path, f"{found} here, expected {word} {detail['ctx'][limit]}")
    expected = _EXPECTED.get(kind, detail["msg"])
    begin = "" if kind == "too_short" else f"{quoted(value)} does not fit, "
    return Complaint(path, begin + expected)


def _cause(detail: ErrorDetails) -> Exception | None:
    cause = detail.get("ctx", {}).get("error")
    return cause if isinstance(cause, Exception) else None


def _path(location: Sequence[str | int], data: object) -> Path:
    """Keep the parts of a pydantic location that exist in the file, dropping tags of unions."""
    path: list[str | int] = []
    at: Any = data
    for part in location:
        in_mapping = isinstance(at, Mapping) and part in at
        in_list = isinstance(at, (list, tuple)) and isinstance(part, int) and part < len(at)
        if in_mapping or in_list:
            at = at[part]
            path.append(part)
    return tuple(path)


def _model_at(path: Path, root: type[BaseModel]) -> type[BaseModel]:
    if not path:
        return root
    block, key = str(path[0]), str(path[-1])
    if block == "steps" and key in BY_WORD:
        return BY_WORD[key].value_model or root
    models: dict[tuple[str, str], type[BaseModel]] = {
        ("balloons", ""): Balloon,
        ("physics", ""): Physics,
        ("physics", "kosaka"): Kosaka,
    }
    return models.get((block, key)) or models.get((block, ""), root)


def _unfit_key(path: Path, data: object) -> str | None:
    """Say why a key of the language does not fit into a step; None of other keys, and of other places."""
    if path[0] != "steps" or len(path) != 3:
        return None
    step, key = data["steps"][path[1]], path[2]  # type: ignore[index]  # the key was found there
    first = next(iter(words_in(step)), None)
    if first is not None and key in WORDS:
        return f"stands beside {first}, expected one operation in a step: begin a new step"
    if first is not None and key in MODIFIERS:
        return f"makes no sense with {first}, expected {one_of(BY_WORD[first].modifiers())}"
    return None


def _unknown_key(path: Path, root: type[BaseModel]) -> str:
    if path[0] == "steps" and len(path) == 3:
        return _unknown_in_step(str(path[-1]), root)
    model = _model_at(path[:-1], root)
    return unknown("key", path[-1], [*model.model_fields, *([] if path[:-1] else [LET])])


def _unknown_in_step(key: str, root: type[BaseModel]) -> str:
    """Say what is meant by a key of a step that is none, or where it stands."""
    if key in CALLED:
        return f"unknown key {quoted(key)}, did you mean {quoted(CALLED[key])}?"
    if key in NOT_THERE:
        return f"{quoted(key)} is not in format 1: {NOT_THERE[key]}"
    if key in root.model_fields:
        return f"{quoted(key)} is said of the whole figure, expected it at the top of the recipe"
    if key in Balloon.model_fields:
        return f"{quoted(key)} is said of a balloon, expected it beside that below balloons"
    return unknown("key", key, [*WORDS, *MODIFIERS, REPEAT])


def _unknown_choice(path: Path, value: object, expected: str) -> str:
    choices = [word or number for word, number in _CHOICE.findall(expected)]
    what = {"size": "balloon size"}.get(str(path[-1]), str(path[-1])) if path else "value"
    if isinstance(value, (str, int)) and not isinstance(value, bool):
        return unknown(what, str(value) if isinstance(value, int) else value, choices)
    return f"{quoted(value)} is no {what}, expected {one_of(choices)}"


def _wanted(path: Path) -> str:
    wanted = {
        "format": "format: 1",
        "name": "a name for the file such as dog",
        "balloons": "balloons such as {main: {size: 260, color: red, tail: 10}}",
        "steps": f"a list of steps, each with {one_of(WORDS)}",
        "joints": "a list such as [nose.end, tail.start]",
        "bubble": "the name of a bubble",
    }
    return wanted.get(str(path[-1]), "it here")
