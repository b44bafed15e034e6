"""A mesh or a cloud of points with what does not move of it, and its values sample by sample."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import UsdGeom
from balloon_usd.stage.properties.reading import Opinions, first_value, opinions_on, value_at
from balloon_usd.stage.properties.triangles import Triangles

if TYPE_CHECKING:
    from numpy.typing import NDArray


SHORTEST = 1e-300
"""Time between two samples [s] by which a distance can still be divided, whatever rate a stage claims."""


@dataclass(frozen=True)
class Shape:
    """A mesh or a cloud of points of an open stage."""

    schema: Any
    """`UsdGeom.Mesh` or `UsdGeom.Points`."""
    sculpted: bool
    """Whether it belongs to a sculpture, not to the scene around it."""
    rate: float
    """Time codes per second."""
    metre: float
    """Metres in a unit of length."""

    @property
    def is_mesh(self) -> bool:
        """Whether it has faces."""
        return isinstance(self.schema, UsdGeom.Mesh)

    @cached_property
    def path(self) -> str:
        """Path of the prim."""
        return str(self.schema.GetPath())

    @cached_property
    def counts(self) -> NDArray[np.int32]:
        """Corners of each face (F,)."""
        return first_value(self.schema.GetFaceVertexCountsAttr()).astype(np.int32)

    @cached_property
    def indices(self) -> NDArray[np.int32]:
        """Vertex numbers of the faces' corners (sum of counts,)."""
        return first_value(self.schema.GetFaceVertexIndicesAttr()).astype(np.int32)

    @cached_property
    def point_count(self) -> int:
        """Number of points of the earliest sample."""
        return len(first_value(self.schema.GetPointsAttr()))

    @cached_property
    def faces_fit(self) -> bool:
        """Whether the faces have corners enough, and all of them are points."""
        counts, indices = self.counts, self.indices
        if not len(counts) or counts.min() < 3 or counts.sum(dtype=np.int64) != len(indices):
            return False
        return bool(indices.min() >= 0 and indices.max() < self.point_count)

    @cached_property
    def triangles(self) -> Triangles | None:
        """Fans of the faces; None where the faces do not fit the points, or there are none."""
        if not (self.is_mesh and self.faces_fit):
            return None
        turned = self.schema.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded
        return Triangles.of(self.counts, self.indices, turned=turned)

    @cached_property
    def lengths(self) -> dict[str, int]:
        """Number of elements of each interpolation."""
        if not self.is_mesh:
            return lengths_of_cloud(self.point_count)
        points, corners = self.point_count, int(self.counts.sum(dtype=np.int64))
        return _lengths(points, faces=len(self.counts), corners=corners)

    def opinions(self) -> Opinions:
        """Where the values come from that decide about its surface and movement."""
        schema = self.schema
        deciding = [schema.GetPointsAttr(), schema.GetExtentAttr(), schema.GetVelocitiesAttr()]
        if self.is_mesh:
            deciding += [schema.GetFaceVertexCountsAttr(), schema.GetFaceVertexIndicesAttr()]
            deciding.append(schema.GetOrientationAttr())
        else:
            deciding.append(schema.GetWidthsAttr())
        return opinions_on(*deciding)


@dataclass(frozen=True)
class Moment:
    """A shape at one of the samples of its points."""

    shape: Shape
    time_code: float | None
    """None for points without samples."""
    points: NDArray[Any]
    """Positions (V, 3), in units of the stage."""
    before: Moment | None = field(default=None, compare=False)
    """The sample before; None for the first one."""

    @property
    def seconds(self) -> float:
        """Time since the sample before."""
        before = self.before.time_code if self.before else None
        elapsed = (self.time_code or 0.0) - (before or 0.0)
        return max(elapsed / self.shape.rate, SHORTEST)

    def value(self, attribute: Any) -> NDArray[Any]:
        """Value of another attribute of the shape at this moment."""
        return value_at(attribute, self.time_code)


@dataclass(frozen=True)
class Value:
    """One sample of an attribute, or its default."""

    attribute: Any
    time_code: float | None
    """None for the default."""
    array: NDArray[Any]
    shape: Shape | None
    """The mesh or the points that it belongs to."""

    @property
    def path(self) -> str:
        """Path of the attribute."""
        return str(self.attribute.GetPath())


def lengths_of_cloud(points: int) -> dict[str, int]:
    """Number of elements of each interpolation, of so many points without faces."""
    return _lengths(points, faces=1, corners=points)


def _lengths(points: int, *, faces: int, corners: int) -> dict[str, int]:
    return {"constant": 1, "uniform": faces, "varying": points, "vertex": points, "faceVarying": corners}
