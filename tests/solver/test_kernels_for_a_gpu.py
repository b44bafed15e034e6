"""Kernels that only a GPU runs are compiled for one, without having any."""

from __future__ import annotations

import pytest
import warp as wp

from balloon_usd.solver.latex.kernel_variants import kernel_variant

OLDEST = 80
"""Compute capability of the oldest GPU that is compiled for: an A100."""
RESIDENT = 65536
"""Bytes of a small sculpture in shared memory."""


@pytest.mark.parametrize(("shared", "resident_bytes", "fingers"), [(False, RESIDENT, False), (True, 0, True)])
def test_the_substeps_compile_for_a_gpu(tmp_path, shared, resident_bytes, fingers):
    kernel = kernel_variant(256, shared=shared, resident_bytes=resident_bytes, cores=False, fingers=fingers)
    (made,) = wp.compile_aot_module(kernel.module, arch=OLDEST, module_dir=tmp_path, use_ptx=True)
    assert "sm_80" in made.read_text(encoding="utf-8", errors="replace")
