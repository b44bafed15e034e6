"""Kernels of the `kosaka` model run one by one, on rubber and air put together at random."""

from __future__ import annotations

import inspect
from dataclasses import dataclass
from typing import Any

import numpy as np
import warp as wp

from balloon_usd.balloon.capsule_mesh import capsule_mesh
from balloon_usd.solver.corners import corner_table
from balloon_usd.solver.kernels.arrays.rows import Constants, Drift
from balloon_usd.solver.kernels.arrays.table import STRUCTS
from balloon_usd.solver.kernels.kosaka.neighbours import LANES
from balloon_usd.solver.kernels.kosaka.offset_regions import WIDER, WIDER_OUTSIDE
from balloon_usd.solver.kosaka.net import edges_of, net_of
from tests.solver import kosaka_reference as thesis

DEVICES = ["cpu", *(device.alias for device in wp.get_cuda_devices())]
"""Where kernels can run on this machine."""

LENGTH, RADIUS, AROUND = 0.08, 0.0255, 12
CLUSTERS = 8
"""More than the highest number of a cluster."""
UNCLEAR = 1e-6
"""How near to the border of an offset region float32 does not know the side: in m, and ten times it in shares."""

LAWS = (
    {
        "ks": 900.0,
        "kd": 7.0,
        "alpha": 400.0,
        "beta": 3.0,
        "push": 40.0,
        "gamma": 0.003,
        "re": 0.010,
        "air_offset": 0.009,
        "contact_offset": 0.002,
        "leak_offset": 0.008,
        "force_limit": 150.0,
        "elongation_limit": 0.25,
        "air_speed": 1e6,
    },
    {
        "ks": 500.0,
        "kd": 11.0,
        "alpha": 700.0,
        "beta": 2.0,
        "push": 25.0,
        "gamma": 0.002,
        "re": 0.008,
        "air_offset": 0.010,
        "contact_offset": 0.003,
        "leak_offset": 0.006,
        "force_limit": 90.0,
        "elongation_limit": 0.15,
        "air_speed": 1e6,
    },
)
"""Constants of two balloons as the thesis has them; what it lacks is 0."""


def laws(**changes: float) -> list[Constants]:
    """Constants of both balloons, with changes."""
    made = []
    for law in LAWS:
        constants = Constants()
        for name, value in (law | changes).items():
            setattr(constants, name, value)
        made.append(constants)
    return made


def drifts() -> list[Drift]:
    """How every cluster of a sample drifts."""
    made = []
    for k in range(CLUSTERS):
        drift = Drift()
        for name, value in drift_of(k).items():
            setattr(drift, name, wp.vec3(*value))
        made.append(drift)
    return made


def drift_of(cluster: int) -> dict[str, np.ndarray]:
    """Where a cluster starts and ends, and how fast."""
    random = np.random.default_rng(cluster)
    start, start_speed, end_speed = single(random.uniform(-0.01, 0.01, (3, 3)))
    end = single(start + [0.05, 0.01, 0.0])
    return {"start": start, "end": end, "start_speed": 50.0 * start_speed, "end_speed": 50.0 * end_speed}


def by_balloon(name: str, balloon) -> np.ndarray:
    """A constant of everything whose balloon this is, as float32 has it."""
    return np.array([law[name] for law in LAWS], dtype=np.float32).astype(float)[balloon]


def lanes_on(device: str) -> int:
    """How many lanes a block has that works on one thing."""
    return LANES if wp.get_device(device).is_cuda else 1


def launch(kernel: Any, device: str, dim: int, **values: Any) -> dict[str, np.ndarray]:
    """Run a kernel on copies of host arrays; return all its arrays as they are afterwards.

    Arrays that are not given are full of zeros: what the thesis does not have is switched off.
    """
    rows = max(len(value) for value in values.values() if isinstance(value, (list, np.ndarray)))
    given: list[Any] = []
    arrays: dict[str, Any] = {}

    def array(name: str, kind: Any) -> Any:
        if name not in arrays:
            given = values.get(name)
            empty = wp.zeros((rows, 2)[: kind.ndim], dtype=kind.dtype, device=device)
            arrays[name] = empty if given is None else wp.array(given, dtype=kind.dtype, device=device)
        return arrays[name]

    for argument in kernel.adj.args:
        name, kind = argument.label, argument.type
        if kind in STRUCTS.values():
            struct = kind()
            for member, field in kind.vars.items():
                setattr(struct, member, array(member, field.type))
            given.append(struct)
        else:
            given.append(array(name, kind) if hasattr(kind, "ndim") else values[name])
    if _by_lanes(kernel):
        wp.launch_tiled(kernel, dim=[dim], inputs=given, block_dim=LANES, device=device)
    else:
        wp.launch(kernel, dim=dim, inputs=given, device=device)
    return {name: array.numpy() for name, array in arrays.items()}


def _by_lanes(kernel: Any) -> bool:
    """Whether a block of threads works on one thing."""
    return "lane = wp.tid()" in inspect.getsource(kernel.func)


def listed(rows: list[np.ndarray], device: str) -> tuple[np.ndarray, np.ndarray]:
    """Lists as kernels read them, shared out over the lanes: how many each lane has, and who."""
    lanes = lanes_on(device)
    capacity = max(1, -(-max(map(len, rows)) // lanes))
    count = np.zeros((len(rows), LANES), dtype=np.int32)
    table = np.full((len(rows), capacity * lanes), -1, dtype=np.int32)
    for k, row in enumerate(rows):
        for lane, part in enumerate(np.array_split(row, lanes)):
            count[k, lane] = len(part)
            table[k, lane * capacity : lane * capacity + len(part)] = part
    return count, table


def members(count: np.ndarray, table: np.ndarray, device: str) -> list[np.ndarray]:
    """What kernels have listed, row by row in the order in which it is read."""
    lanes = lanes_on(device)
    capacity = table.shape[1] // lanes
    return [
        np.concatenate([row[lane * capacity : lane * capacity + n[lane]] for lane in range(lanes)])
        for n, row in zip(count, table, strict=True)
    ]


def off(result, wanted) -> float:
    """Relative error: the norm of the difference over the norm of what is wanted."""
    return float(np.linalg.norm(np.asarray(result, dtype=float) - wanted) / np.linalg.norm(wanted))


def leftover(vectors) -> float:
    """How far vectors are from adding up to nothing, as a share of the sum of their sizes."""
    vectors = np.asarray(vectors, dtype=float)
    return float(np.linalg.norm(vectors.sum(axis=0)) / np.linalg.norm(vectors, axis=1).sum())


def single(values) -> np.ndarray:
    """Values rounded as a device keeps them, for the reference: both sides start from the same numbers."""
    return np.asarray(values, dtype=np.float32).astype(float)


@dataclass(frozen=True)
class Sample:
    """Two dented capsules through each other: clusters alone keep their air apart. The first has two bubbles."""

    quads: np.ndarray
    quad_balloon: np.ndarray
    quad_cluster: np.ndarray
    vertex_balloon: np.ndarray
    edges: np.ndarray
    edge_balloon: np.ndarray
    natural: np.ndarray
    """By edge, (E,)."""
    x: np.ndarray
    v: np.ndarray
    air: np.ndarray
    air_speed: np.ndarray
    air_balloon: np.ndarray
    air_cluster: np.ndarray

    @property
    def triangles(self) -> np.ndarray:
        return thesis.triangles_of(self.quads)

    @property
    def face_cluster(self) -> np.ndarray:
        return np.repeat(self.quad_cluster, 2)

    @property
    def face_balloon(self) -> np.ndarray:
        return np.repeat(self.quad_balloon, 2)

    @property
    def same_cluster(self) -> np.ndarray:
        """Which particles belong to which triangles, (T, P)."""
        return self.face_cluster[:, None] == self.air_cluster

    def host(self, **changes: float) -> dict[str, Any]:
        """Arrays by the names that the kernels give them."""
        net = net_of(self.edges, self.natural, len(self.x))
        return {
            "quads": self.quads,
            "quad_balloon": self.quad_balloon,
            "quad_world": np.zeros(len(self.quads), dtype=np.int32),
            "quad_cluster": self.quad_cluster,
            "balloon_world": np.zeros(len(LAWS), dtype=np.int32),
            "vertex_balloon": self.vertex_balloon,
            "vertex_joint": np.full(len(self.x), -1, dtype=np.int32),
            "corners": corner_table(self.quads, len(self.x)),
            "spring_ends": net.ends,
            "natural": net.natural,
            "constants": laws(**changes),
            "x": self.x,
            "v": self.v,
            "air": self.air,
            "air_speed": self.air_speed,
            "air_balloon": self.air_balloon,
            "air_cluster": self.air_cluster,
        }


def sample(seed: int, particles: int = 500) -> Sample:
    """Put rubber and air together at random."""
    random = np.random.default_rng(seed)
    mesh = capsule_mesh(LENGTH, RADIUS, AROUND, (LENGTH,))
    vertices, faces = len(mesh.points), len(mesh.quads)
    quads = np.concatenate([mesh.quads, mesh.quads + vertices])
    x = np.concatenate([mesh.points, mesh.points + [0.013, 0.004, -0.006]])
    x = single(x + random.normal(0.0, 8e-4, x.shape))
    edges = edges_of(quads)
    stretch = random.uniform(0.7, 1.3, len(edges))
    natural = single(stretch * thesis.length(x[edges[:, 1]] - x[edges[:, 0]]))
    first = x[mesh.quads].mean(axis=1)[:, 0] < 0.5 * LENGTH
    air = single(random.uniform(x.min(axis=0), x.max(axis=0), (particles, 3)))
    air_balloon = random.integers(0, 2, particles).astype(np.int32)
    half = np.where(air[:, 0] < 0.5 * LENGTH, 3, 5)
    made = Sample(
        quads=quads.astype(np.int32),
        quad_balloon=np.repeat([0, 1], faces).astype(np.int32),
        quad_cluster=np.concatenate([np.where(first, 3, 5), np.full(faces, 7)]).astype(np.int32),
        vertex_balloon=np.repeat([0, 1], vertices).astype(np.int32),
        edges=edges,
        edge_balloon=(edges[:, 0] >= vertices).astype(np.int32),
        natural=natural,
        x=x,
        v=single(random.normal(0.0, 0.2, x.shape)),
        air=air,
        air_speed=single(random.normal(0.0, 0.3, air.shape)),
        air_balloon=air_balloon,
        air_cluster=np.where(air_balloon == 0, half, 7).astype(np.int32),
    )
    return _only(made, _clear(made))


def _only(made: Sample, kept: np.ndarray) -> Sample:
    names = ("air", "air_speed", "air_balloon", "air_cluster")
    return Sample(**(vars(made) | {name: getattr(made, name)[kept] for name in names}))


def _clear(s: Sample) -> np.ndarray:
    """Which particles lie clearly on one side of every border of every offset region, (P,)."""
    _, d, uvw = thesis.regions(s.triangles, s.x, s.air)
    beside = uvw.min(axis=2)
    over = beside + np.where(d < 0.0, WIDER, WIDER_OUTSIDE)
    borders = (
        np.zeros(len(d)),
        -by_balloon("air_offset", s.face_balloon),
        by_balloon("leak_offset", s.face_balloon),
    )
    close = np.any([np.abs(d - at[:, None]) < UNCLEAR for at in borders], axis=0)
    close &= beside > -max(WIDER, WIDER_OUTSIDE) - 10.0 * UNCLEAR
    close |= np.abs(over) < 10.0 * UNCLEAR
    # Which of two walls is the nearer must be clear too.
    sizes = np.sort(np.where(s.same_cluster & (over > 0.0), np.abs(d), 1.0), axis=0)
    tied = (np.diff(sizes[:2], axis=0) < UNCLEAR).any(axis=0) & (sizes[0] < 1.0)
    return ~(close.any(axis=0) | tied)
