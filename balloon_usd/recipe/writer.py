"""Write a recipe as YAML, the way a maker would: blocks outside, one line for each step."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING

from balloon_usd.language.quantities import duration_entry, length_entry, short_number
from balloon_usd.language.scalars import plain_scalar
from balloon_usd.operations.modifiers import MODIFIERS

from .kosaka import kosaka_entries

if TYPE_CHECKING:
    from collections.abc import Iterable

    from balloon_usd.operations.operation import Operation

    from .balloons import Balloon

Entries = dict[str, object]

HEAD = ("name", "title", "source", "units", "fps", "tempo")
"""Keys between the format and the balloons, in this order."""
END = ("pose", "height", "speed", "front", "top", "symmetric", "mirror", "must_hold")
"""Keys behind the steps, in this order."""

_PLAIN_WORD = re.compile(r"[A-Za-z_][A-Za-z0-9_.+ -]*", re.ASCII)


def recipe_entries(
    written: Entries, balloons: Mapping[str, Balloon], steps: Iterable[Operation], units: str | None
) -> Entries:
    """Plain data of a recipe as it stands in a file: lengths in its units, angles in degrees.

    Args:
        written: all of the recipe that differs from what is usual.
        balloons: by name.
        steps: in order.
        units: of lengths that are bare numbers.
    """
    kept: Entries = {key: written[key] for key in HEAD if key in written}
    entries: Entries = {
        "format": written["format"],
        **kept,
        "balloons": {name: _balloon_entries(entry, units) for name, entry in balloons.items()},
        "steps": [step_entries(step, units) for step in steps],
    }
    entries |= {key: written[key] for key in END if key in written}
    if isinstance(height := written.get("height"), float):
        entries["height"] = length_entry(height, units)
    physics = written.get("physics")
    if isinstance(physics, dict):
        entries["physics"] = _physics_entries(physics, units)
    return entries


def recipe_text(entries: Mapping[str, object]) -> str:
    """YAML text of the plain data of a recipe."""
    lines: list[str] = []
    for key, value in entries.items():
        if key == "steps" and isinstance(value, list) and value:
            lines.append("steps:")
            for step in value:
                lines += _step_lines(step)
        elif key in ("balloons", "physics") and isinstance(value, Mapping) and value:
            lines.append(f"{key}:")
            lines += [f"  {_text(name)}: {flow_text(entry)}" for name, entry in value.items()]
        else:
            lines.append(f"{_text(key)}: {flow_text(value)}")
    return "\n".join(lines) + "\n"


def _balloon_entries(balloon: Balloon, units: str | None) -> Entries:
    entries: Entries = {} if balloon.size is None else {"size": _size_entry(balloon.size)}
    entries |= balloon.model_dump(include={"mesh", "unit", "swell", "filled"}, exclude_none=True)
    if balloon.at is not None:
        entries["at"] = [length_entry(place, units) for place in balloon.at]
    if "color" in balloon.model_fields_set:
        entries["color"] = balloon.model_dump(include={"color"})["color"]
    if balloon.finish != "latex":
        entries["finish"] = balloon.finish
    for key in ("tail", "inflated", "overblown", "capsule", "radius", "length", "thickness"):
        length = getattr(balloon, key)
        if length is not None:
            entries[key] = length_entry(length, units)
    return entries


def _size_entry(size: str) -> int | str:
    return int(size) if size.isdecimal() else size


def step_entries(step: Operation, units: str | None) -> Entries:
    """Plain data of a step as it stands in a file: lengths in units, angles in degrees."""
    written = step.model_dump(exclude_defaults=True)
    beside = {key: written[key] for key in MODIFIERS if key in written}
    return {step.word: step.entry(units), **beside}


def _physics_entries(physics: Entries, units: str | None) -> Entries:
    kosaka, leak = physics.get("kosaka"), physics.get("leak")
    if isinstance(kosaka, Mapping):
        physics = physics | {"kosaka": kosaka_entries(kosaka, units)}
    if isinstance(leak, float):
        physics = physics | {"leak": duration_entry(leak)}
    return physics


def _step_lines(step: object) -> list[str]:
    if not isinstance(step, Mapping) or not step:
        return [f"  - {flow_text(step)}"]
    lines = [f"    {_text(key)}: {flow_text(value)}" for key, value in step.items()]
    return ["  - " + lines[0][4:], *lines[1:]]


def flow_text(value: object) -> str:
    """YAML text of plain data, or of NumPy's, on one line, as it may stand anywhere in a recipe."""
    if hasattr(value, "tolist"):
        return flow_text(value.tolist())
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_text(key)}: {flow_text(entry)}" for key, entry in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(flow_text(entry) for entry in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return _number(value)
    return "null" if value is None else _text(str(value))


def _number(value: float) -> str:
    if math.isnan(value):
        return ".nan"
    if value in (float("inf"), float("-inf")):
        return ".inf" if value > 0 else "-.inf"
    return repr(short_number(value))


def _text(text: str) -> str:
    plain = _PLAIN_WORD.fullmatch(text) and not text.endswith(" ") and plain_scalar(text) == text
    return text if plain else '"' + "".join(_escaped(letter) for letter in text) + '"'


def _escaped(letter: str) -> str:
    """Escape what YAML would fold, refuse, or take for the end of the text."""
    if letter in '"\\':
        return "\\" + letter
    if letter.isprintable():
        return letter
    return f"\\U{ord(letter):08X}"
