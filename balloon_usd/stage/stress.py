"""Stretch as a colour: the samples that only the look `stress` brings into a stage."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Sdf, UsdGeom
from balloon_usd.stage.animated import on_stress
from balloon_usd.stage.prim_paths import part_path, root_path

if TYPE_CHECKING:
    from balloon_usd.stage.description import StageDescription
    from balloon_usd.stage.pose import Pose

STILL = "__finished__"
"""Root prim, in the layer of the samples, that holds the final colours alone: a default beside samples
would not be a still, and one in a stronger layer would hide them."""


class StressColors:
    """The colours of every mesh on their way into a layer."""

    def __init__(self, layer: Any, description: StageDescription) -> None:
        """Declare them in the layer, below the sculpture's root."""
        self._layer, self._description = layer, description
        self._color = on_stress(description.highest_stretch)
        self._paths = self._declare(root_path(description.name))
        self.bytes_a_frame = 12 * sum(mesh.vertex_count for mesh in description.meshes)

    def write(self, time_code: int, pose: Pose) -> None:
        """Set one sample of every mesh."""
        for path, mesh in zip(self._paths, pose.meshes, strict=True):
            self._layer.SetTimeSample(path, time_code, self._color.read(mesh))

    def close(self, final: Pose, *, still: bool) -> None:
        """Set what still viewers show, and with `still` once more below `STILL`, where no samples are."""
        self._set_defaults(self._paths, final)
        if still:
            self._set_defaults(self._declare(Sdf.Path.absoluteRootPath.AppendChild(STILL)), final)

    def _declare(self, root: Any) -> tuple[Any, ...]:
        name = self._description.name
        found = []
        for mesh in self._description.meshes:
            place = part_path(name, mesh.name).ReplacePrefix(root_path(name), root)
            prim = Sdf.CreatePrimInLayer(self._layer, place)
            color = Sdf.AttributeSpec(prim, self._color.name, self._color.type_name)
            color.SetInfo("interpolation", UsdGeom.Tokens.vertex)
            color.documentation = self._color.documentation
            found.append(color.path)
        return tuple(found)

    def _set_defaults(self, paths: tuple[Any, ...], final: Pose) -> None:
        for path, mesh in zip(paths, final.meshes, strict=True):
            self._layer.GetAttributeAtPath(path).default = self._color.read(mesh)
