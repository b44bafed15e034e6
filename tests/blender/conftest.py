"""Blender in a process of its own: these tests run wherever the module bpy is installed."""

from __future__ import annotations

import multiprocessing
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

collect_ignore_glob = [] if find_spec("bpy") else ["test_*.py"]


@pytest.fixture(scope="session")
def blender(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[..., Any]]:
    """Call a function, named as "module:function", in Blender's process, and return what it returns."""
    home = tmp_path_factory.mktemp("blender")
    apart = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, apart, initializer=settle, initargs=(str(home),)) as process:
        yield lambda name, *given, **named: process.submit(call, name, given, named).result()
    # A process with Blender's USD and this package's breaks down when it ends.
    assert "bpy" not in sys.modules


def settle(home: str) -> None:
    """Keep extensions and preferences out of the user's own."""
    os.environ["BLENDER_USER_RESOURCES"] = home


def call(name: str, given: tuple[object, ...], named: dict[str, object]) -> Any:
    module, function = name.split(":")
    return getattr(import_module(f"tests.blender.{module}"), function)(*given, **named)
