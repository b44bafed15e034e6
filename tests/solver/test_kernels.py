"""Every kernel takes its data from the scene by name, in one order."""

from __future__ import annotations

import importlib
import pkgutil
from pathlib import Path

import pytest
import warp as wp

from balloon_usd.balloon.detail import detail_named
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_mesh import tube_mesh
from balloon_usd.plan import plan as plan_recipe
from balloon_usd.recipe import Recipe
from balloon_usd.solver import kernels
from balloon_usd.solver.latex.body import tube_body
from balloon_usd.solver.latex.launch_shape import SculptureLaunch
from balloon_usd.solver.latex.scene import build_scene
from balloon_usd.solver.settings import SceneSettings
from balloon_usd.solver.simulation import simulate_many

CHANGING = {
    "dt",
    "fraction",
    "frame_seconds",
    "air",
    "touch",
    "grid",
    "margin",
    "quad_half",
    "substeps",
    "interval",
    "sculpture_blocks",
    "joint_blocks",
    "begin",
    "end",
    "walls",
    "pressing",
    "travel_limit",
}
"""Arguments that are no arrays of the scene."""

ORDERLESS = ("hit_count", "most_hits", "most_near", "pair_count", "pressed_count", "wp.atomic_max(fastest")
"""Counts and maxima, which do not depend on who comes first; nor does what is done with lists so counted."""

CAPSULE = """\
format: 1
name: capsule
units: cm
balloons: {main: {size: 260, capsule: 20}}
steps: [wait: 1]
physics: {model: kosaka}
"""


def all_kernels():
    found = {}
    for module in pkgutil.walk_packages(kernels.__path__, kernels.__name__ + "."):
        for thing in vars(importlib.import_module(module.name)).values():
            if isinstance(thing, wp.Kernel):
                found[thing.key] = thing
    return found


@pytest.fixture(scope="module")
def arrays():
    size = size_named("260")
    mesh = tube_mesh(size, detail_named("draft"), (0.03,), (0.03, size.length))
    body = tube_body(mesh, rubber_named(), size.radius, size.thickness, (0.03,), (), 5000.0)
    scene = build_scene([body], [0], SceneSettings(dt=4e-4), "cpu", 1, 1)
    SculptureLaunch(scene)
    return scene.arrays | kosaka_arrays()


def kosaka_arrays():
    plan = plan_recipe(Recipe.parse(CAPSULE))
    return simulate_many([plan], device="cpu").model.scene.arrays


@pytest.mark.parametrize("name", sorted(all_kernels()))
def test_every_argument_of_a_kernel_is_an_array_of_the_scene(arrays, name):
    kernel = all_kernels()[name]
    missing = [a.label for a in kernel.adj.args if a.label not in CHANGING and a.label not in arrays]
    assert not missing


@pytest.mark.parametrize("name", sorted(all_kernels()))
def test_every_kernel_says_what_it_writes(name):
    assert all_kernels()[name].func.__doc__


def test_no_kernel_adds_floats_atomically():
    for module in pkgutil.walk_packages(kernels.__path__, kernels.__name__ + "."):
        source = Path(importlib.import_module(module.name).__file__).read_text(encoding="utf-8")
        for line in source.splitlines():
            if "atomic_" in line:
                assert any(name in line for name in ORDERLESS), line
