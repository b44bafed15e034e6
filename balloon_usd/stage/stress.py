"""Stretch as a colour: the samples that only the look `stress` brings into a stage."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Sdf, UsdGeom, Vt
from balloon_usd.stage.animated import colors_of_stress, shades_of_stress
from balloon_usd.stage.prim_paths import part_path, root_path
from balloon_usd.stage.stretch_color import RAMP, ramp_legend

if TYPE_CHECKING:
    from balloon_usd.stage.description import StageDescription
    from balloon_usd.stage.pose import Pose

STILL = "__finished__"
"""Root prim, in the layer of the samples, that holds the final colours alone: a default beside samples
would not be a still, and one in a stronger layer would hide them."""


class StressColors:
    """The colours of every mesh on their way into a layer.

    Indexed, the ramp stands there once and a sample is the number of each vertex's colour: integers that a
    crate packs to a byte or less, where a colour takes twelve. Plain, a sample is the colours themselves, for
    readers that know no indices.
    """

    def __init__(self, layer: Any, description: StageDescription, *, indexed: bool) -> None:
        """Declare them in the layer, below the sculpture's root."""
        self._layer, self._description, self._indexed = layer, description, indexed
        highest = description.highest_stretch
        self._moving = shades_of_stress(highest) if indexed else colors_of_stress(highest)
        self._paths = self._declare(root_path(description.name))
        vertices = sum(mesh.vertex_count for mesh in description.meshes)
        self.bytes_a_frame = (4 if indexed else 12) * vertices

    def write(self, time_code: int, pose: Pose) -> None:
        """Set one sample of every mesh."""
        for path, mesh in zip(self._paths, pose.meshes, strict=True):
            self._layer.SetTimeSample(path, time_code, self._moving.read(mesh))

    def close(self, final: Pose, *, still: bool) -> None:
        """Set what still viewers show, and with `still` once more below `STILL`, where no samples are."""
        self._set_defaults(self._paths, final)
        if still:
            self._set_defaults(self._declare(Sdf.Path.absoluteRootPath.AppendChild(STILL)), final)

    def _declare(self, root: Any) -> tuple[Any, ...]:
        """Create the attributes of all meshes below a root; returns the paths of those that move."""
        name = self._description.name
        found = []
        for mesh in self._description.meshes:
            place = part_path(name, mesh.name).ReplacePrefix(root_path(name), root)
            prim = Sdf.CreatePrimInLayer(self._layer, place)
            color = Sdf.AttributeSpec(
                prim, UsdGeom.Tokens.primvarsDisplayColor, Sdf.ValueTypeNames.Color3fArray
            )
            color.SetInfo("interpolation", UsdGeom.Tokens.vertex)
            color.documentation = ramp_legend(self._description.highest_stretch)
            if self._indexed:
                color.default = Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(RAMP))
                color = Sdf.AttributeSpec(prim, self._moving.name, self._moving.type_name)
            found.append(color.path)
        return tuple(found)

    def _set_defaults(self, paths: tuple[Any, ...], final: Pose) -> None:
        for path, mesh in zip(paths, final.meshes, strict=True):
            self._layer.GetAttributeAtPath(path).default = self._moving.read(mesh)
