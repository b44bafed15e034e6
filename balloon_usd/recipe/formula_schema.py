"""Named values, formulas and repeats in the JSON Schema: what may be written where the models want values."""

from __future__ import annotations

from typing import Any

from balloon_usd.language.names import NAME_LIMIT, NAME_PATTERN

from .counters import MOST_REPEATS
from .repeats import LET, NOTE, REPEAT, STEPS, TEXTS

Schema = dict[str, Any]

FILLED = r"<[^<>]+>"
"""A formula in a name."""
FILLED_NAME = f"(?:[A-Za-z_]|{FILLED})(?:[A-Za-z0-9_]|{FILLED})*"
SCALARS = ("number", "integer", "boolean")

_FORMULA: Schema = {"$ref": "#/$defs/Formula"}
_NAMES: Schema = {"propertyNames": {"maxLength": NAME_LIMIT}}
_VALUE: Schema = {"anyOf": [{"type": "number"}, {"type": "string"}, {"type": "boolean"}]}
_TIMES: Schema = {"maximum": MOST_REPEATS, "minimum": 1, "type": "integer"}


def with_formulas(schema: Schema) -> Schema:
    """Return the schema of a recipe as it is written: values may be formulas, steps and balloons repeated."""
    found: Schema = _filled(schema)
    top = found["properties"]
    top["name"] = schema["properties"]["name"]
    top |= {key: _or_formula(value) for key, value in top.items() if key not in TEXTS}
    steps = top[STEPS]["items"] = {"oneOf": [*top[STEPS]["items"]["oneOf"], {"$ref": "#/$defs/Repeat"}]}
    top[LET] = {
        "description": "Values by names, which formulas use.",
        "patternProperties": {f"^{NAME_PATTERN}$": _VALUE},
        "additionalProperties": False,
        **_NAMES,
        "title": "Let",
        "type": "object",
    }
    found["$defs"] |= {
        "Formula": {
            "description": "Arithmetic on numbers, quantities and names: = 2 * ear + 1 cm, or <side>.",
            "pattern": rf"^\s*=|{FILLED}",
            "title": "Formula",
            "type": "string",
        },
        "Counters": _counters(),
        "Repeat": _repeat(found, steps),
    }
    found["$defs"]["Balloon"]["properties"][REPEAT] = {
        "$ref": "#/$defs/Counters",
        "description": "One balloon for each value of the counters, which its name tells.",
    }
    return found


def _counters() -> Schema:
    """Return the schema of what counts repeats."""
    column = {"anyOf": [_TIMES, {"type": "string"}, {"items": _VALUE, "minItems": 1, "type": "array"}]}
    by_name = {"patternProperties": {f"^{NAME_PATTERN}$": column}, **_NAMES, "minProperties": 1}
    by_name["additionalProperties"] = False
    return {
        "anyOf": [_TIMES, _FORMULA, {**by_name, "type": "object"}],
        "description": "How often: a number, or counters: {k: 9}, {k: 2 to 9}, {side: [left, right]}.",
        "title": "Counters",
    }


def _repeat(schema: Schema, steps: Schema) -> Schema:
    """Return the schema of steps that are repeated."""
    note = schema["$defs"]["Wait"]["properties"][NOTE]
    return {
        "additionalProperties": False,
        "description": "Do these steps once for each value of the counters.",
        "properties": {
            REPEAT: {"$ref": "#/$defs/Counters"},
            STEPS: {"items": steps, "minItems": 1, "type": "array"},
            NOTE: note,
        },
        "required": [REPEAT, STEPS],
        "title": "Repeat",
        "type": "object",
    }


def _filled(schema: Any) -> Any:
    """Let names have formulas in them, and entries of blocks be formulas."""
    if isinstance(schema, list):
        return [_filled(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    found = {key.replace(NAME_PATTERN, FILLED_NAME): _filled(value) for key, value in schema.items()}
    if isinstance(found.get("pattern"), str):
        found["pattern"] = found["pattern"].replace(NAME_PATTERN, FILLED_NAME)
    for key in ("$defs", "patternProperties"):
        if key in found:
            found[key] = {name: _parts_or_formulas(part) for name, part in found[key].items()}
    if isinstance(found.get("items"), dict):
        found["items"] = _or_formula(found["items"])
    return found


def _parts_or_formulas(block: Schema) -> Schema:
    """Let the entries of a block, or a value by a name, be formulas."""
    if "properties" in block:
        entries = {key: _or_formula(part, key) for key, part in block["properties"].items()}
        return {**block, "properties": entries}
    return _or_formula(block)


def _or_formula(part: Schema, key: str = "") -> Schema:
    """Let a plain value be a formula."""
    if key == NOTE or not _is_scalar(part):
        return part
    told: Schema = {each: part[each] for each in ("title", "description", "default") if each in part}
    value = {each: rule for each, rule in part.items() if each not in told}
    choices = value["anyOf"] if set(value) == {"anyOf"} else [value]
    return {"anyOf": [*choices, _FORMULA], **told}


def _is_scalar(part: Schema) -> bool:
    choices = part.get("anyOf") or part.get("oneOf") or ()
    fixed = part.get("type") == "string" and ("pattern" in part or "enum" in part)
    return fixed or "enum" in part or part.get("type") in SCALARS or any(map(_is_scalar, choices))
