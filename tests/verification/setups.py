"""General set-ups for verification: a few meshes, a rig that runs the real stepper on them, and settling.

A new case takes a mesh, makes it a `Rig`, settles it and measures:

- `plate`: a flat sheet; `cube_sphere`: a sphere, one chamber.
- `tube` with `parts=()`: a closed tube, one chamber; with `parts=(k,)`: two chambers with ring k between them.
- `tube` as it is: an open tube, its gas in chamber 1; with `Rig.hold_length` a piece of an endless one.
- `revolved`: any other body of rings.

Bodies that touch each other, some of them held, are a `Meeting`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from balloon_usd.balloon.air import GAS_CONSTANT, ROOM_TEMPERATURE
from balloon_usd.balloon.rubber import Rubber
from balloon_usd.balloon.tube_theory import TubeState
from balloon_usd.solver.body import RingSpec
from balloon_usd.solver.latex.body import LatexBody
from balloon_usd.solver.latex.controls import LatexControls
from balloon_usd.solver.latex.scene import LatexScene, build_scene
from balloon_usd.solver.latex.stepper import Stepper
from balloon_usd.solver.settings import SceneSettings

if TYPE_CHECKING:
    from collections.abc import Sequence

Floats = NDArray[np.float64]

wp.config.log_level = wp.LOG_WARNING

STEP = 1.0e-4
"""Time step of quasi-static cases, s; with scaled masses its size does not matter."""
SUBSTEPS = 20
"""Substeps between two looks at the kinetic energy."""
HELD = 1.0e12
"""Mass of a vertex that is held, in its own."""
GOSSAMER = 1.0e-4
"""Wall thickness of a tube's end caps, in wall thicknesses: they close the mesh and carry nothing."""


@dataclass(frozen=True)
class Mesh:
    """A mesh of quads with what a `LatexBody` asks for besides."""

    points: Floats
    """(V, 3), m, unstressed."""
    quads: NDArray[np.int32]
    """(Q, 4), counter-clockwise from outside."""
    radius: float
    """Scale, m."""
    rings: tuple[RingSpec, ...] = ()
    """Rings for hands."""
    mesh_rings: tuple[tuple[int, int], ...] = ((0, 1),)
    """All rings as (first vertex, vertices)."""
    segment_ends: tuple[int, ...] = ()
    """End of every chamber's run of quads; empty for one chamber."""
    caps: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(0, dtype=bool))
    """Quads that only close the mesh, (Q,); empty for none."""


class Rig:
    """A mesh of one rubber in a scene of its own, run by the real stepper."""

    touches = False
    """Whether walls can touch."""

    def __init__(
        self,
        mesh: Mesh,
        rubber: Rubber,
        thickness: float,
        *,
        gauge: tuple[float, ...] = (0.0,),
        vented: tuple[int, ...] = (),
        neck: float = 0.0,
        dt: float = STEP,
        substeps: int = SUBSTEPS,
        atmosphere: float = 101325.0,
        drag: float = 0.0,
        gravity: float = 0.0,
        scale_mass: bool = True,
        inertia: float = 1.0,
    ) -> None:
        self.mesh = mesh
        self.body = body_of(mesh, rubber, thickness, gauge=gauge, vented=vented, neck=neck)
        settings = SceneSettings(
            dt=dt, atmosphere=atmosphere, drag=drag, gravity=gravity, scale_mass=scale_mass
        )
        self._build([self.body], settings, substeps, inertia)

    def _build(
        self, bodies: Sequence[LatexBody], settings: SceneSettings, substeps: int, inertia: float
    ) -> None:
        """Put bodies in a scene of their own."""
        wp.init()
        self.scene = build_scene(bodies, [0] * len(bodies), settings, "cpu", 1, 1)
        # Masses are scaled for rubber like latex; one that stiffens a hundredfold needs more.
        self.scene.mass.assign((inertia * self.array("mass")).astype(np.float32))
        self.stepper = Stepper(self.scene, substeps)
        self.hands = LatexControls(self.scene)
        # Chambers exchange no gas, although their rings are wide open.
        self.hands.passage[:] = self.hands.passage_goal[:] = 0.0

    def array(self, name: str) -> NDArray[Any]:
        """A copy of one of the scene's arrays, floats as float64."""
        values = self.scene.arrays[name].numpy()
        return values.astype(np.float64) if values.dtype.kind == "f" else values.copy()

    @property
    def wall(self) -> NDArray[np.intp]:
        """Vertices of all quads but those that only close the mesh."""
        return np.unique(self.mesh.quads[~self.mesh.caps] if len(self.mesh.caps) else self.mesh.quads)

    @property
    def points(self) -> Floats:
        """Where all vertices are, (V, 3), m."""
        return self.array("x")

    def place(self, points: Floats) -> None:
        """Put all vertices somewhere, at rest; rings and chambers start afresh."""
        self.scene.x.assign(points.astype(np.float32))
        self.scene.v.zero_()
        self.stepper._start()

    def fill(self, chamber: int, pressure: float) -> None:
        """Seal gas into a chamber that was just placed: this gauge pressure (Pa) at its present volume."""
        amount, volume = self.array("amount"), self.array("volume")
        amount[chamber] = (
            (self.scene.settings.atmosphere + pressure) * volume[chamber] / (GAS_CONSTANT * ROOM_TEMPERATURE)
        )
        self.scene.amount.assign(amount)

    def press(self, chamber: int, pressure: float) -> None:
        """Set the gauge pressure (Pa) of a vented chamber."""
        pressures = self.array("pressure")
        pressures[chamber] = pressure
        self.scene.pressure.assign(pressures.astype(np.float32))

    def hold_length(self) -> None:
        """Hold the middles of all rings for hands where they are: an open tube then is a piece of an endless one."""
        for ring in range(len(self.mesh.rings)):
            self.hands.grip(ring, self.array("ring_middle").astype(np.float32))

    def advance(self) -> None:
        """Advance by one frame of the rig's substeps."""
        self.hands.upload()
        self.stepper.advance(contact=self.touches)
        self.hands.arrived()

    def forces(self) -> Floats:
        """Force on every vertex, (V, 3), N: what the next two substeps change of its momentum."""
        self.scene.v.zero_()
        self.advance()
        return (
            self.array("mass")[:, None] * self.array("v") / (self.stepper.substeps * self.scene.settings.dt)
        )

    def kinetic_energy(self) -> float:
        """J."""
        return float(0.5 * (self.array("mass") * (self.array("v") ** 2).sum(axis=1)).sum())

    def momentum(self) -> tuple[Floats, Floats]:
        """Momentum (kg m/s) and angular momentum about the centre of mass (kg m2/s), (3,) each."""
        return momentum_of(self.scene)

    def settle(self, tolerance: float = 2.0e-5, most: int = 400) -> None:
        """Bring everything to rest: motion is stopped at every peak of the kinetic energy (Barnes 1999).

        It ends when nothing moved by more than `tolerance` (in radii) between three peaks, one after the other.

        Raises:
            AssertionError: that did not happen within `most` frames.
        """
        wall = self.wall
        before, energy, quiet, moved = self.points, 0.0, 0, math.inf
        for _ in range(most):
            self.advance()
            now = self.kinetic_energy()
            if now < energy:
                self.scene.v.zero_()
                here = self.points
                moved = np.abs(here - before)[wall].max()
                before, now = here, 0.0
                quiet = quiet + 1 if moved < tolerance * self.mesh.radius else 0
                if quiet == 3:
                    return
            energy = now
        raise AssertionError(
            f"not at rest after {most} frames: still moving {moved / self.mesh.radius:.1e} radii"
        )


@dataclass(frozen=True)
class Part:
    """A body that meets others."""

    mesh: Mesh
    thickness: float
    """m"""
    gauge: float = 0.0
    """Gauge pressure in its chamber, which keeps it, Pa."""
    held: NDArray[np.intp] = field(default_factory=lambda: np.arange(0))
    """Vertices that give way to nothing and go on as they move; a part that is held all over does not fall."""


class Meeting(Rig):
    """Bodies of one rubber whose walls can touch, in a scene of their own."""

    touches = True

    def __init__(
        self,
        parts: Sequence[Part],
        rubber: Rubber,
        settings: SceneSettings,
        *,
        substeps: int = SUBSTEPS,
        inertia: float = 1.0,
    ) -> None:
        self.parts = tuple(parts)
        counts = np.cumsum([0] + [len(part.mesh.points) for part in parts])
        self.mesh = Mesh(
            points=np.concatenate([part.mesh.points for part in parts]),
            quads=np.concatenate([part.mesh.quads + counts[k] for k, part in enumerate(parts)]),
            radius=parts[0].mesh.radius,
        )
        bodies = [
            body_of(part.mesh, rubber, part.thickness, gauge=(part.gauge,), vented=(0,)) for part in parts
        ]
        self._build(bodies, settings, substeps, inertia)
        self.vertices = [slice(first, end) for first, end in pairwise(counts)]
        """Those of every part."""
        mass, gravity = self.array("mass"), self.array("gravity")
        for k, part in enumerate(parts):
            mass[counts[k] + part.held] *= HELD
            gravity[k] *= len(part.held) < len(part.mesh.points)
        self.scene.mass.assign(mass.astype(np.float32))
        self.scene.gravity.assign(gravity.astype(np.float32))
        self.hands.touch(range(len(parts)))

    def place(self, points: Floats) -> None:
        """Put all vertices somewhere, at rest; there walls are apart, and chambers start afresh."""
        super().place(points)
        self.stepper._untangling.leave()

    def push(self, part: int, other: int) -> Floats:
        """Force of contact on a part by another, (3,), N, as in the last substep."""
        whose = self.array("vertex_balloon")
        # On a CPU the vectors of one vertex lie together.
        force = self.array("contact_force").reshape(-1, 2, 3)
        target = self.array("target")
        touched = np.where(target >= 0, self.array("quad_balloon")[target], -1)
        on = force[(whose[:, None] == part) & (touched == other)].sum(axis=0)
        back = force[(whose[:, None] == other) & (touched == part)].sum(axis=0)
        return on - back

    def hold(self, part: int) -> Floats:
        """Force that keeps the vertices of a part that are held where they are, (3,), N: what they would gain in
        momentum.
        """
        own = self.vertices[part]
        return -self.forces()[own][self.parts[part].held].sum(axis=0)


def body_of(
    mesh: Mesh,
    rubber: Rubber,
    thickness: float,
    *,
    gauge: tuple[float, ...] = (0.0,),
    vented: tuple[int, ...] = (),
    neck: float = 0.0,
) -> LatexBody:
    """A mesh of one rubber, its wall as thick as that all over (m)."""
    wall = np.full(len(mesh.quads), thickness)
    wall[np.flatnonzero(mesh.caps)] *= GOSSAMER
    middles = np.array([mesh.points[f : f + n].mean(axis=0) for f, n in mesh.mesh_rings])
    nearest = np.linalg.norm(mesh.points[:, None] - middles[None], axis=2).argmin(axis=1)
    return LatexBody(
        points=mesh.points.astype(np.float32),
        rest=mesh.points.astype(np.float64),
        quads=mesh.quads,
        thickness=wall,
        rubber=rubber,
        worked=np.zeros(len(mesh.quads)),
        radius=mesh.radius,
        along=mesh.points[:, 0].astype(np.float32),
        mesh_rings=mesh.mesh_rings,
        vertex_ring=nearest.astype(np.int32),
        rings=mesh.rings,
        segment_ends=np.array(mesh.segment_ends or (len(mesh.quads),), dtype=np.int32),
        gauge=np.array(gauge, dtype=np.float64),
        vented=vented,
        inlet=len(gauge) // 2,
        neck_radius=neck or mesh.radius,
    )


def momentum_of(scene: LatexScene) -> tuple[Floats, Floats]:
    """Momentum (kg m/s) and angular momentum about the centre of mass (kg m2/s) of all there is, (3,) each."""
    mass, x, v = (scene.arrays[name].numpy().astype(np.float64) for name in ("mass", "x", "v"))
    mass = mass[:, None]
    centre = (mass * x).sum(axis=0) / mass.sum()
    return (mass * v).sum(axis=0), (mass * np.cross(x - centre, v)).sum(axis=0)


def plate(columns: int, rows: int, size: float, distortion: float = 0.0) -> Mesh:
    """A flat square plate of `size` (m); inner vertices are displaced by up to `distortion` cells."""
    u, v = np.meshgrid(np.arange(columns + 1.0), np.arange(rows + 1.0), indexing="ij")
    shift = np.random.default_rng(7).uniform(-distortion, distortion, (2, *u.shape))
    shift[:, [0, -1]] = 0.0
    shift[:, :, [0, -1]] = 0.0
    points = np.stack([(u + shift[0]) * size / columns, (v + shift[1]) * size / rows, 0.0 * u], axis=-1)
    grid = np.arange(u.size, dtype=np.int32).reshape(u.shape)
    return Mesh(points.reshape(-1, 3), _quads(grid), size)


def cube_sphere(radius: float, cells: int) -> Mesh:
    """A sphere: the six faces of a cube, `cells` by `cells` quads each, at equal angles."""
    angle = np.tan(np.linspace(-0.25, 0.25, cells + 1) * math.pi)
    u, v = np.meshgrid(angle, angle, indexing="ij")
    one = np.ones_like(u)
    faces = [(one, u, v), (-one, v, u), (v, one, u), (u, -one, v), (u, v, one), (v, u, -one)]
    every = np.stack([np.stack(f, axis=-1).reshape(-1, 3) for f in faces])
    every /= np.linalg.norm(every, axis=2, keepdims=True)
    _, first, inverse = np.unique(
        np.round(every.reshape(-1, 3), 9), axis=0, return_index=True, return_inverse=True
    )
    grid = inverse.reshape(6, cells + 1, cells + 1).astype(np.int32)
    quads = np.concatenate([_quads(face) for face in grid])
    return Mesh(radius * every.reshape(-1, 3)[first], quads, radius)


def turned(points: Floats, angle: float) -> Floats:
    """Points turned about the z axis, (V, 3), m; `angle`: radians."""
    cos, sin = math.cos(angle), math.sin(angle)
    return points @ np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])


def tube(radius: float, around: int, stations: Floats, parts: tuple[int, ...] = (0, -1)) -> Mesh:
    """A tube along x with its rings at `stations` (m); the rings `parts` border chambers and can be held.

    An end cap is of gossamer where its ring is a border: the tube then is open, with a chamber of nothing at its end.
    """
    return revolved(np.full(len(stations), radius), around, stations, parts)


def revolved(radii: Floats, around: int, stations: Floats, parts: tuple[int, ...] = ()) -> Mesh:
    """A body of revolution along x, its rings of `radii` (m) at `stations` (m), and flat caps; `parts` as in a tube.

    The cross-section is circumscribed to the circle, as that of a balloon is.
    """
    angle = 2.0 * math.pi * np.arange(around) / around
    circle = np.stack([0.0 * angle, np.cos(angle), np.sin(angle)], axis=1) / math.cos(math.pi / around)
    along = np.array([1.0, 0.0, 0.0])
    wall = np.concatenate([r * circle + s * along for r, s in zip(radii, stations, strict=True)])
    flat = [_disc(around, radii[k] * circle) + stations[k] * along for k in (0, -1)]
    points = np.concatenate([wall, *flat])
    ring = np.arange(len(wall), dtype=np.int32).reshape(-1, around)
    first = _cap(ring[0], len(wall))[:, ::-1]
    last = _cap(ring[-1], len(wall) + len(flat[0]))
    # Rows of a sheet's grid run round the tube; sheets follow each other along it.
    closed = np.concatenate([ring, ring[:, :1]], axis=1)
    sheets = [_quads(closed[k : k + 2].T) for k in range(len(ring) - 1)]
    quads = np.concatenate([first, *sheets, last]).astype(np.int32)
    borders = sorted(p % len(ring) for p in parts)
    caps = np.zeros(len(quads), dtype=bool)
    caps[: len(first)] = 0 in borders
    caps[-len(last) :] = len(ring) - 1 in borders
    return Mesh(
        points=points,
        quads=quads,
        radius=float(radii.max()),
        rings=tuple(RingSpec(int(ring[b, 0]), around, parts=True) for b in borders),
        mesh_rings=tuple((int(f), around) for f in ring[:, 0]),
        segment_ends=(*(len(first) + around * b for b in borders), len(quads)),
        caps=caps,
    )


def stretched(mesh: Mesh, hoop: float, axial: float) -> Floats:
    """Points of a tube at these stretches, (V, 3), m."""
    return mesh.points * np.array([axial, hoop, hoop])


def ring_stretches(rig: Rig) -> tuple[Floats, Floats]:
    """Hoop stretch of every ring of a tube, (R,), and axial stretch between rings, (R - 1,)."""
    x, around = rig.points, rig.mesh.mesh_rings[0][1]
    rings = np.stack([x[f : f + around] for f, _ in rig.mesh.mesh_rings])
    rest = np.stack([rig.mesh.points[f : f + around] for f, _ in rig.mesh.mesh_rings])
    girth = np.linalg.norm(rings - np.roll(rings, 1, axis=1), axis=2).sum(axis=1)
    rest_girth = np.linalg.norm(rest - np.roll(rest, 1, axis=1), axis=2).sum(axis=1)
    # Quads stretch along the middles of their hoop edges.
    middles = 0.5 * (rings + np.roll(rings, 1, axis=1))
    rest_middles = 0.5 * (rest + np.roll(rest, 1, axis=1))
    length = np.linalg.norm(np.diff(middles, axis=0), axis=2).mean(axis=1)
    return girth / rest_girth, length / np.linalg.norm(np.diff(rest_middles, axis=0), axis=2).mean(axis=1)


def polygon_factor(around: int) -> float:
    """Area of the polygon circumscribed to a circle, in areas of the circle."""
    return around * math.tan(math.pi / around) / math.pi


def at_energy_of(rig: Rig, state: TubeState) -> None:
    """Let all rubber remember this state as its largest stretch so far."""
    energy = float(rig.body.rubber.energy(state.a, state.b))
    rig.scene.peak_energy.fill_(energy)


def plain(rubber: Rubber) -> Rubber:
    """The rubber without softening."""
    return replace(rubber, softening=None)


def _quads(grid: NDArray[np.int32]) -> NDArray[np.int32]:
    return np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=-1).reshape(-1, 4)


def _disc(around: int, circle: Floats) -> Floats:
    """Inner points of a flat cap, row by row."""
    cells = around // 4
    border = np.arange(around)
    grid = np.zeros((cells + 1, cells + 1), dtype=int)
    grid[:cells, 0], grid[cells, :cells] = border[:cells], border[cells : 2 * cells]
    grid[cells:0:-1, cells], grid[0, cells:0:-1] = border[2 * cells : 3 * cells], border[3 * cells :]
    t = np.arange(1, cells)[:, None, None] / cells
    p = circle[grid]
    s = t.transpose(1, 0, 2)
    ruled = (1 - t) * p[:1, 1:-1] + t * p[-1:, 1:-1] + (1 - s) * p[1:-1, :1] + s * p[1:-1, -1:]
    corners = (
        (1 - t) * (1 - s) * p[0, 0] + t * (1 - s) * p[-1, 0] + t * s * p[-1, -1] + (1 - t) * s * p[0, -1]
    )
    return (ruled - corners).reshape(-1, 3)


def _cap(ring: NDArray[np.int32], inner: int) -> NDArray[np.int32]:
    """Quads of a cap, counter-clockwise seen from +x when its ring runs so."""
    cells = len(ring) // 4
    grid = np.zeros((cells + 1, cells + 1), dtype=np.int32)
    grid[:cells, 0], grid[cells, :cells] = ring[:cells], ring[cells : 2 * cells]
    grid[cells:0:-1, cells], grid[0, cells:0:-1] = ring[2 * cells : 3 * cells], ring[3 * cells :]
    grid[1:cells, 1:cells] = inner + np.arange((cells - 1) ** 2, dtype=np.int32).reshape(cells - 1, cells - 1)
    return _quads(grid)
