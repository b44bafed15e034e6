"""Kernels of the count of crossings."""
