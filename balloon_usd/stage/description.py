"""What a stage shows: meshes with fixed topology, particles of air, and the frames that move them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal, NamedTuple, Protocol

import numpy as np

from balloon_usd.openusd import Sdf, usd_access
from balloon_usd.stage.error import StageError
from balloon_usd.stage.provenance import GIVEN, problems
from balloon_usd.stage.stretch_color import LOWEST_STRETCH

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray


class StageFrame(Protocol):
    """One moment of the animation. Arrays may be reused by the sender after the next frame is asked for."""

    @property
    def time_code(self) -> int:
        """Whole time code, 1 or later, one more than that of the frame before."""

    @property
    def points(self) -> tuple[NDArray[np.float32], ...]:
        """Positions [m], one (V, 3) float32 array a mesh."""

    @property
    def stretch(self) -> tuple[NDArray[np.float32], ...]:
        """Largest principal stretch [1], one (V,) float32 array a mesh."""

    @property
    def pressure(self) -> NDArray[np.float32]:
        """Pressure above that of the gas about it [Pa], (bubbles,) float32 in the order of
        `StageDescription.bubble_names`.
        """

    @property
    def volume(self) -> NDArray[np.float32]:
        """Gas volume [m3], (bubbles,) float32 in the order of `StageDescription.bubble_names`."""

    @property
    def air(self) -> tuple[NDArray[np.float32], ...]:
        """Particle positions [m], one (P, 3) float32 array for each of `StageDescription.airs`.

        Not read where there are none.
        """

    @property
    def cluster(self) -> tuple[NDArray[np.int32], ...]:
        """Bubble of every particle, one (P,) int32 array for each of `StageDescription.airs`.

        Counted in the order of `StageDescription.bubble_names`; not read where there is no air.
        """


class Seam(NamedTuple):
    """Vertices of several bubbles, and the corners of quads around them."""

    vertices: NDArray[np.int32]
    """Vertex numbers (S,)."""
    quads: NDArray[np.int64]
    """Number of quads around each of them (S,)."""
    place: NDArray[np.intp]
    """Which of the vertices each corner lies at (C,), counted through `vertices`."""
    bubble: NDArray[np.int32]
    """Bubble of each corner's quad (C,), an index into the mesh's `bubble_names`."""


@dataclass(frozen=True)
class MeshDescription:
    """One balloon: a closed quad cage whose topology never changes.

    Raises:
        StageError: Arrays do not fit each other, or a name is no USD identifier.
    """

    name: str
    """Prim name."""
    quads: NDArray[np.int32]
    """Vertex numbers (Q, 4) int32, counter-clockwise seen from outside."""
    st: NDArray[np.float32]
    """Texture coordinates (Q, 4, 2) float32 of the quads' corners."""
    quad_bubble: NDArray[np.int32]
    """Bubble of each quad (Q,) int32, an index into this mesh's `bubble_names`."""
    bubble_names: tuple[str, ...]
    """Names that `quad_bubble` counts in: this mesh's own or those of the whole sculpture."""
    color: tuple[float, float, float]
    """Colour of the latex, linear RGB in 0..1."""
    material: str
    """Prim name of the material; meshes of one colour share the first one's."""
    finish: Literal["latex", "clear", "chrome"] = "latex"
    """What the wall looks like in the colours of the recipe: shiny, see-through or metallic."""

    def __post_init__(self) -> None:
        for name in (self.name, self.material, *self.bubble_names):
            require_identifier(name)
        count = len(self.quads)
        _require(count > 0, f'mesh "{self.name}" has no quads')
        _require(self.quads.shape == (count, 4), f'mesh "{self.name}": quads have shape {self.quads.shape}')
        _require(self.quads.min() >= 0, f'mesh "{self.name}": negative vertex number')
        _require(self.st.shape == (count, 4, 2), f'mesh "{self.name}": st has shape {self.st.shape}')
        _require(
            self.quad_bubble.shape == (count,),
            f'mesh "{self.name}": quad_bubble has shape {self.quad_bubble.shape}',
        )
        _require(
            self.quad_bubble.min() >= 0 and self.quad_bubble.max() < len(self.bubble_names),
            f'mesh "{self.name}": quad_bubble points outside its {len(self.bubble_names)} bubble names',
        )
        _require(
            all(0.0 <= channel <= 1.0 for channel in self.color),
            f'mesh "{self.name}": colour {self.color} is not in 0..1',
        )

    @cached_property
    def vertex_count(self) -> int:
        """Number of vertices V."""
        return int(self.quads.max()) + 1

    @cached_property
    def quads_at_vertex(self) -> NDArray[np.int64]:
        """Number of quads around each vertex (V,)."""
        return np.bincount(self.quads.ravel(), minlength=self.vertex_count)

    @cached_property
    def vertex_bubble(self) -> NDArray[np.int32]:
        """A bubble of each vertex (V,), an index into this mesh's `bubble_names`."""
        bubble = np.zeros(self.vertex_count, dtype=np.int32)
        bubble[self.quads] = self.quad_bubble[:, None]
        return bubble

    @cached_property
    def seam(self) -> Seam:
        """The vertices at which several bubbles meet."""
        corners, at_corners = self.quads.ravel(), np.repeat(self.quad_bubble, 4)
        mixed = np.zeros(self.vertex_count, dtype=bool)
        mixed[corners[at_corners != self.vertex_bubble[corners]]] = True
        there = np.flatnonzero(mixed[corners])
        vertices, place = np.unique(corners[there], return_inverse=True)
        return Seam(vertices, self.quads_at_vertex[vertices], place, at_corners[there])


@dataclass(frozen=True)
class AirDescription:
    """The air in one balloon: particles whose number never changes.

    Raises:
        StageError: The name is no USD identifier, there are no particles, or they have no size.
    """

    name: str
    """Prim name."""
    count: int
    """Number of particles P."""
    width: float
    """Diameter of a drawn particle [m]."""

    def __post_init__(self) -> None:
        require_identifier(self.name)
        _require(self.count > 0, f'air "{self.name}" has {self.count} particles')
        _require(0.0 < self.width < float("inf"), f'air "{self.name}": width is {self.width}')


@dataclass(frozen=True)
class StageDescription:
    """One sculpture: its balloons and everything that does not move.

    Raises:
        StageError: A name is no USD identifier or is used twice, or the provenance is not complete.
    """

    name: str
    """Name of the root prim, the folder and the file."""
    title: str
    """One line for people, stored as the layer's documentation."""
    fps: float
    """Frames and time codes per second."""
    meshes: tuple[MeshDescription, ...]
    bubble_names: tuple[str, ...]
    """Bubbles of the whole sculpture, in the order of `StageFrame.pressure`."""
    provenance: Mapping[str, str | int | float]
    """At least "recipe", "recipe_sha256" and "solver"; no dates, hosts or durations."""
    twists: tuple[tuple[int, str], ...] = ()
    """When each step of the recipe begins: (time code, what is done)."""
    airs: tuple[AirDescription, ...] = ()
    """Air of the balloons, in the order of `StageFrame.air`; empty for models without particles."""
    highest_stretch: float = 7.0
    """Stretch at which the colours of the look `stress` end: that at which latex bursts."""
    lands: bool = False
    """Whether the figure stands or falls on the ground, the plane z = 0, in the end."""

    def __post_init__(self) -> None:
        require_identifier(self.name)
        _require(len(self.meshes) > 0, f'"{self.name}" has no meshes')
        _require(0.0 < self.fps < float("inf"), f'"{self.name}": fps is {self.fps}')
        highest = self.highest_stretch
        _require(LOWEST_STRETCH < highest < float("inf"), f'"{self.name}": highest stretch is {highest}')
        prims = [*(mesh.name for mesh in self.meshes), *(air.name for air in self.airs)]
        for names in (prims, self.bubble_names):
            twice = {name for name in names if list(names).count(name) > 1}
            _require(not twice, f'"{self.name}": name used twice: {", ".join(sorted(twice))}')
        for mesh in self.meshes:
            used = {mesh.bubble_names[index] for index in np.unique(mesh.quad_bubble)}
            unknown = ", ".join(sorted(used - {*self.bubble_names}))
            _require(not unknown, f'mesh "{mesh.name}": not among the sculpture\'s bubbles: {unknown}')
        for problem in problems(self.provenance, GIVEN):
            raise StageError(f'"{self.name}": {problem}')

    def numbers_of(self, mesh: MeshDescription) -> NDArray[np.int32]:
        """Each of a mesh's `bubble_names` as an index into the sculpture's; -1 where it has no quad."""
        number = {name: index for index, name in enumerate(self.bubble_names)}
        return np.array([number.get(name, -1) for name in mesh.bubble_names], dtype=np.int32)

    def bubbles_of(self, mesh: MeshDescription) -> NDArray[np.int32]:
        """Bubble of each quad of a mesh (Q,) int32, as an index into the sculpture's `bubble_names`."""
        return self.numbers_of(mesh)[mesh.quad_bubble]


@usd_access()
def require_identifier(name: str) -> None:
    """Refuse what cannot name a prim and a file.

    Raises:
        StageError: The name has other characters than letters, digits and underscores.
    """
    if not (name.isascii() and Sdf.Path.IsValidIdentifier(name)):
        raise StageError(f'"{name}" cannot name a prim: use letters, digits and underscores')


def _require(condition: bool, otherwise: str) -> None:
    if not condition:
        raise StageError(otherwise)
