"""Warp kernels of the benchmarks."""
