"""Data goes one way: no module needs, directly or through others, one that needs it."""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

import networkx as nx
import pytest

import balloon_usd

ROOT = Path(balloon_usd.__file__).parents[1]
FLOORS = ("stage", "solver", "plan", "recipe", "operations", "language")
"""Rooms of the main line, the uppermost first: none imports one above it."""


@cache
def modules() -> dict[str, Path]:
    """Return the files of all modules by their names."""
    found = {}
    for file in sorted((ROOT / "balloon_usd").rglob("*.py")):
        name = ".".join(file.relative_to(ROOT).with_suffix("").parts)
        found[name.removesuffix(".__init__")] = file
    return found


def named_in(node: ast.AST, package: str) -> list[str]:
    """Return the modules that an import names, with those that its names may be."""
    if isinstance(node, ast.Import):
        return [each.name for each in node.names]
    if not isinstance(node, ast.ImportFrom):
        return []
    parts = package.split(".")[: len(package.split(".")) + 1 - node.level] if node.level else []
    base = ".".join([*parts, *filter(None, [node.module])])
    return [f"{base}.{each.name}" if f"{base}.{each.name}" in modules() else base for each in node.names]


@cache
def imports() -> nx.DiGraph:
    """Return which module imports which, also where it does for types alone, or when it runs."""
    graph = nx.DiGraph()
    graph.add_nodes_from(modules())
    for name, file in modules().items():
        package = name if file.name == "__init__.py" else name.rpartition(".")[0]
        for node in ast.walk(ast.parse(file.read_text())):
            graph.add_edges_from(
                (name, other) for other in named_in(node, package) if other in modules() and other != name
            )
    return graph


def circles(graph: nx.DiGraph) -> list[list[str]]:
    return [sorted(each) for each in nx.strongly_connected_components(graph) if len(each) > 1]


def test_no_modules_import_each_other_in_a_circle() -> None:
    assert circles(imports()) == []


def test_no_rooms_import_each_other_in_a_circle() -> None:
    rooms = nx.DiGraph()
    for name, other in imports().edges:
        room, needed = (".".join(each.split(".")[:2]) for each in (name, other))
        if room != needed:
            rooms.add_edge(room, needed)
    assert rooms.number_of_nodes() > 15
    assert circles(rooms) == []


@pytest.mark.parametrize("floor", FLOORS)
def test_no_room_of_the_main_line_imports_one_above_it(floor: str) -> None:
    above = FLOORS[: FLOORS.index(floor)]
    own = [(name, other) for name, other in imports().edges if name.split(".")[1:2] == [floor]]
    assert own
    assert [
        (name, other) for name, other in own if other.split(".")[1:2] and other.split(".")[1] in above
    ] == []
