"""Warp kernels of the preview."""

import warp as wp

# Copied into each module when its first kernel is defined, so it must be set before the imports below it.
wp.config.enable_backward = False
