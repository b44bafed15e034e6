"""The moving attributes of a sculpture in a layer, and one sample of all of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from balloon_usd.openusd import Sdf
from balloon_usd.stage.animated import ON_AIR, ON_MESH, ON_ROOT
from balloon_usd.stage.prim_paths import part_path, root_path

if TYPE_CHECKING:
    from balloon_usd.stage.animated import Animated
    from balloon_usd.stage.description import StageDescription
    from balloon_usd.stage.pose import AirPose, MeshPose, Pose

P = TypeVar("P")


@dataclass(frozen=True)
class Track(Generic[P]):
    """The moving attributes of one prim."""

    moving: tuple[Animated[P], ...]
    paths: tuple[Any, ...]

    def sample(self, layer: Any, time_code: int, pose: P) -> None:
        """Set one sample of every attribute."""
        for path, animated in zip(self.paths, self.moving, strict=True):
            layer.SetTimeSample(path, time_code, animated.read(pose))


@dataclass(frozen=True)
class Tracks:
    """The moving attributes of a sculpture."""

    meshes: tuple[Track[MeshPose], ...]
    airs: tuple[Track[AirPose], ...]
    root: Track[Pose]

    @classmethod
    def declare(cls, layer: Any, description: StageDescription) -> Tracks:
        """Create the attributes in a layer."""

        def declared(part: str, moving: tuple[Animated[P], ...]) -> Track[P]:
            prim = Sdf.CreatePrimInLayer(layer, part_path(description.name, part))
            return Track(moving, tuple(Sdf.AttributeSpec(prim, a.name, a.type_name).path for a in moving))

        meshes = tuple(declared(mesh.name, ON_MESH) for mesh in description.meshes)
        airs = tuple(declared(air.name, ON_AIR) for air in description.airs)
        root = layer.GetPrimAtPath(root_path(description.name))
        custom = {"variability": Sdf.VariabilityVarying, "declaresCustom": True}
        paths = tuple(Sdf.AttributeSpec(root, a.name, a.type_name, **custom).path for a in ON_ROOT)
        return cls(meshes, airs, Track(ON_ROOT, paths))

    def sample(self, layer: Any, time_code: int, pose: Pose) -> None:
        """Set one sample of every attribute."""
        for mesh_track, mesh in zip(self.meshes, pose.meshes, strict=True):
            mesh_track.sample(layer, time_code, mesh)
        for air_track, air in zip(self.airs, pose.airs, strict=True):
            air_track.sample(layer, time_code, air)
        self.root.sample(layer, time_code, pose)
