"""A function fits on a screen or two; one that does not says why."""

from __future__ import annotations

import ast
from pathlib import Path

import balloon_usd

PACKAGE = Path(balloon_usd.__file__).parent
MOST_LINES = 80
LONGER = {
    "solver/kernels/physics/joints.py:move_joint": (
        "a group of lanes holds a joint's state in registers from its gathering to its landing"
    ),
    "solver/kernels/physics/membrane_simd.py:walls_simd": "one native snippet: C++ in a string",
    "solver/kernels/physics/sculpture.py:substep_kernel": (
        "the outline of a substep, inside the factory that makes its variants"
    ),
}
"""Functions that are longer, and why."""


def lengths() -> dict[str, int]:
    """Return the lines of all functions by file and name."""
    found = {}
    for file in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) and node.end_lineno:
                name = f"{file.relative_to(PACKAGE).as_posix()}:{node.name}"
                found[name] = max(found.get(name, 0), node.end_lineno - node.lineno + 1)
    return found


def test_no_function_is_longer_than_two_screens_without_a_reason():
    assert {name for name, lines in lengths().items() if lines > MOST_LINES} == set(LONGER)
