"""Every device array stands in the table once, with what it is, and scenes and kernels keep to it."""

from __future__ import annotations

import ast
import importlib
import pkgutil
from pathlib import Path

import numpy as np
import pytest
import warp as wp

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver import kernels
from balloon_usd.solver.device_arrays import DeviceArrays
from balloon_usd.solver.kernels.arrays.shared import State
from balloon_usd.solver.kernels.arrays.table import ARRAYS, STRUCTS, array, array_struct
from balloon_usd.solver.simulation import simulate_many
from tests.solver.all_kernels import all_kernels

MOST_ARGUMENTS = 16
LONGER: dict[str, str] = {}
"""Kernels that take more arguments, and why."""
RECIPES = {
    "latex": "format: 1\nname: a\nunits: cm\nballoons: {main: {size: 260, length: 14, tail: 5}}\nsteps: [bubbles: {a: 8}]\n",
    "kosaka": "format: 1\nname: b\nunits: cm\nballoons: {main: {size: 260, capsule: 20}}\nsteps: [wait: 1]\nphysics: {model: kosaka}\n",
}


@pytest.fixture(scope="module")
def scenes():
    return [simulate_many([plan(Recipe.parse(text))], device="cpu").model.scene for text in RECIPES.values()]


def arrays_of(kernel):
    """All arrays that a kernel takes, alone or in a struct: name, type."""
    for arg in kernel.adj.args:
        if arg.type in STRUCTS.values():
            yield from ((name, field.type) for name, field in arg.type.vars.items())
        else:
            yield arg.label, arg.type


@pytest.mark.parametrize("name", sorted(all_kernels()))
def test_every_array_that_a_kernel_takes_is_in_the_table(name):
    for label, kind in arrays_of(all_kernels()[name]):
        if hasattr(kind, "ndim"):
            assert label in ARRAYS
            assert kind.dtype is ARRAYS[label].dtype
            assert kind.ndim == len(ARRAYS[label].shape)


@pytest.mark.parametrize("name", sorted(all_kernels()))
def test_no_kernel_takes_more_arguments_than_a_reader_can_follow(name):
    assert len(all_kernels()[name].adj.args) <= MOST_ARGUMENTS or LONGER[name]


def test_every_array_of_a_scene_is_as_the_table_says(scenes):
    for arrays in (scene.arrays for scene in scenes):
        for name, values in arrays.items():
            assert values.dtype is ARRAYS[name].dtype, name
            assert values.shape == arrays.shape(name), name


def test_every_array_of_the_table_is_in_a_scene(scenes):
    assert set().union(*(scene.arrays for scene in scenes)) == set(ARRAYS)


def test_kernels_use_every_array_of_the_table():
    used = set()
    for module in pkgutil.walk_packages(kernels.__path__, kernels.__name__ + "."):
        if ".arrays." not in module.name:
            source = Path(importlib.import_module(module.name).__file__).read_text(encoding="utf-8")
            nodes = list(ast.walk(ast.parse(source)))
            used |= {node.attr for node in nodes if isinstance(node, ast.Attribute)}
            used |= {node.arg for node in nodes if isinstance(node, ast.arg)}
    assert set(ARRAYS) - used == {"air_world"}, "the hash grid takes it, no kernel of ours"


def test_every_array_says_what_it_holds():
    for spec in ARRAYS.values():
        assert spec.meaning
        assert spec.shape
        # Counts and indices have no unit.
        assert not (spec.unit and spec.type_name == "int"), spec.name


def test_a_host_array_of_the_wrong_shape_is_refused():
    arrays = DeviceArrays("cpu", {"vertices": 3})
    with pytest.raises(ValueError, match=r"mass has the shape \(4,\): expected 3 vertices"):
        arrays.put({"mass": np.ones(4, np.float32)})


def test_an_array_that_is_not_in_the_table_is_refused():
    with pytest.raises(KeyError, match="weight"):
        DeviceArrays("cpu", {"vertices": 3}).put({"weight": np.ones(3, np.float32)})


def test_a_struct_has_the_array_that_replaced_another():
    arrays = DeviceArrays("cpu", {"vertices": 3, "segments": 1})
    arrays.zero_others(State)
    before = arrays.struct(State)
    assert arrays.struct(State) is before
    arrays["x"] = wp.ones(3, dtype=wp.vec3, device="cpu")
    assert arrays.struct(State).x is arrays["x"]
    assert arrays.struct(State).v is before.v


def test_two_arrays_of_one_name_are_refused():
    with pytest.raises(ValueError, match="State has an array of that name"):

        @array_struct
        class Twice:
            """Another place for positions."""

            x: wp.array[wp.vec3] = array("vertices", unit="m", meaning="position")
