"""A figure of two ears, laid out as its plan has it."""

from __future__ import annotations

import numpy as np

EARS = """\
format: 1
name: ears
units: cm
balloons:
  main: {size: 260, length: 30, tail: 6}
steps:
  - bubbles: {nose: 8, left_ear: 9, right_ear: 9}
  - lock: [left_ear, right_ear]
    point: up
  - bubbles: {neck: 7}
  - rest: tail
physics: {hold: 1}
"""


def points_of(plan, meshes):
    """A tube along a path: ears are a loop that is its own mirror image, from one joint back to it."""
    (mesh,) = meshes
    ends = [0.0, *(bubble.rest_end for bubble in plan.bubbles)]
    before = np.clip(mesh.along, 0.0, ends[1])
    loop = np.clip((mesh.along - ends[1]) / (ends[3] - ends[1]), 0.0, 1.0) * 2.0 * np.pi
    after = np.clip(mesh.along - ends[3], 0.0, None)
    x = before + after + np.clip(mesh.along, None, 0.0)
    points = np.zeros((len(x), 3))
    points[:, 0], points[:, 1], points[:, 2] = x, 0.05 * np.sin(loop), 0.05 * (1.0 - np.cos(loop))
    # Narrow enough to be closed, and apart from each other everywhere.
    return (points + 0.2 * mesh.points * [0.0, 1.0, 1.0]).astype(np.float32)
