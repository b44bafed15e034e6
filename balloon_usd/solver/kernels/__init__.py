"""Warp kernels of the solver: one idea each; arguments in the order topology, material, state, outputs."""

import warp as wp

# Before any kernel is defined: options are copied into a module when it is made.
wp.config.enable_backward = False
