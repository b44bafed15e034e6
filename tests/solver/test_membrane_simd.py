"""Quads side by side get the forces that each gets alone, however many there are."""

from __future__ import annotations

import numpy as np
import pytest
import warp as wp

from balloon_usd.balloon.detail import detail_named
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_mesh import tube_mesh
from balloon_usd.solver.kernels.arrays.latex import Chambers, Forces, Rubber
from balloon_usd.solver.kernels.arrays.shared import Mesh, State
from balloon_usd.solver.kernels.physics.membrane import wall_of_quad
from balloon_usd.solver.kernels.physics.membrane_simd import SIMD_QUADS, walls_simd
from balloon_usd.solver.latex.body import tube_body
from balloon_usd.solver.latex.scene import build_scene
from balloon_usd.solver.settings import SceneSettings

ROUNDING = 1e-6
"""Largest difference, as a share of the largest value: a product and a sum may be rounded once or twice."""
WRITTEN = ("corner_force", "volume_gradient", "peak_energy", "chunk_share")


@wp.kernel
def one_by_one(mesh: Mesh, rubber: Rubber, chambers: Chambers, forces: Forces, state: State):
    """Write what each quad of a chunk gets alone."""
    c = wp.tid()
    for q in range(mesh.chunk_quad[c], mesh.chunk_quad[c + 1]):
        chambers.chunk_share[c] = chambers.chunk_share[c] + wall_of_quad(
            q, state.x[mesh.chunk_origin[c]], 0, mesh, rubber, forces, state
        )


@wp.kernel
def abreast(mesh: Mesh, rubber: Rubber, chambers: Chambers, forces: Forces, state: State):
    """Write what they get side by side."""
    walls_simd(0, chambers.chunk_share.shape[0], mesh, rubber, chambers, forces, state)


def scene():
    """A tube drawn out unevenly, so that some of its wall is stretched and some is slack."""
    size = size_named("260")
    mesh = tube_mesh(size, detail_named("draft"), (0.03,), (0.03, size.length))
    body = tube_body(mesh, rubber_named(), size.radius, size.thickness, (0.03,), (), 5000.0)
    made = build_scene([body], [0], SceneSettings(dt=4e-4), "cpu", 1, 1)
    chance = np.random.default_rng(1)
    x = made.x.numpy()
    made.x.assign(x * chance.uniform(0.8, 2.0, x.shape).astype(np.float32))
    made.v.assign(chance.normal(size=x.shape).astype(np.float32))
    made.peak_energy.assign(chance.uniform(0.0, 1e5, len(made.quads)).astype(np.float32))
    return made


def written(kernel, starts):
    """What a kernel writes for chunks that begin at some quads, the last of which is the end of the last."""
    made = scene()
    made.arrays["chunk_quad"] = wp.array(starts, dtype=int, device="cpu")
    made.arrays["chunk_origin"] = wp.zeros(len(starts) - 1, dtype=int, device="cpu")
    made.arrays["chunk_share"] = wp.zeros(len(starts) - 1, dtype=float, device="cpu")
    inputs = [made.arrays.struct(a.type) for a in kernel.adj.args]
    wp.launch(kernel, dim=1 if kernel is abreast else len(starts) - 1, inputs=inputs, device="cpu")
    return {name: made.arrays[name].numpy() for name in WRITTEN}


@pytest.mark.parametrize("count", [1, SIMD_QUADS - 1, SIMD_QUADS, 2 * SIMD_QUADS + 3])
def test_quads_side_by_side_get_what_each_gets_alone(count):
    starts = [5, 5 + count, 40 + 2 * count]
    alone, together = written(one_by_one, starts), written(abreast, starts)
    for name, expected in alone.items():
        apart = np.abs(together[name] - expected).max()
        assert apart <= ROUNDING * np.abs(expected).max(), name


def test_quads_beside_are_left_alone():
    before, after = scene(), written(abreast, [5, 8])
    quads = len(before.quads)
    kept = np.delete(np.arange(quads), [5, 6, 7])
    for name in ("corner_force", "volume_gradient", "peak_energy"):
        # On a CPU the vectors of one quad lie together.
        was, now = (values.reshape(quads, -1) for values in (before.arrays[name].numpy(), after[name]))
        assert np.array_equal(now[kept], was[kept])
        assert not np.array_equal(now, was)
