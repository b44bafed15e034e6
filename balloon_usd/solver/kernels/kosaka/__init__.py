"""Kernels of the thesis's model: springs, air particles and offset regions (Kosaka 2008)."""
