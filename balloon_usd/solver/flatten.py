"""Bodies laid end to end: host arrays whose indices are global over all balloons of all sculptures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from balloon_usd.balloon.sizes import NECK_REACH
from balloon_usd.solver.corners import corner_table
from balloon_usd.solver.kernels.device.warp_reduce import WARP

if TYPE_CHECKING:
    from balloon_usd.solver.body import Body
    from balloon_usd.solver.flat_bodies import FlatBodies

Arrays = dict[str, NDArray[Any]]


def mesh_arrays(scene: FlatBodies, host: Arrays) -> None:
    """Topology of quads and vertices."""
    bodies = scene.bodies
    index = np.arange(len(bodies), dtype=np.int32)
    v, q, s = scene.vertex_start, scene.quad_start, scene.segment_start
    host["quads"] = np.concatenate([b.quads + v[k] for k, b in enumerate(bodies)]).astype(np.int32)
    tables = [corner_table(b.quads, len(b.points)) for b in bodies]
    host["corners"] = _joined_corners(tables, [len(b.points) for b in bodies], q)
    segments = [np.searchsorted(b.segment_ends, np.arange(len(b.quads)), side="right") for b in bodies]
    host["quad_segment"] = np.concatenate([g + s[k] for k, g in enumerate(segments)]).astype(np.int32)
    host["quad_balloon"] = np.repeat(index, np.diff(q)).astype(np.int32)
    host["balloon_world"] = np.asarray(scene.worlds, dtype=np.int32)
    around = scene.hosts
    host["world_guests"] = np.bincount(
        host["balloon_world"], weights=around >= 0, minlength=max(scene.worlds) + 1
    ).astype(np.int32)
    host["balloon_host"] = around.astype(np.int32)
    host["quad_host"] = host["balloon_host"][host["quad_balloon"]]
    host["balloon_nested"] = ((around >= 0) | np.isin(index, around)).astype(np.int32)
    host["vertex_balloon"] = np.repeat(index, np.diff(v)).astype(np.int32)
    places = [b.along_only if b.place is None else b.place for b in bodies]
    host["vertex_place"] = np.concatenate(places).astype(np.float32)
    middles = [place[b.quads].mean(axis=1) for place, b in zip(places, bodies, strict=True)]
    host["quad_place"] = np.concatenate(middles).astype(np.float32)
    outward = [np.zeros_like(b.points) if b.outward is None else b.outward for b in bodies]
    host["vertex_outward"] = np.concatenate(outward).astype(np.float32)
    sides = [side[b.quads].mean(axis=1) for side, b in zip(outward, bodies, strict=True)]
    host["quad_outward"] = np.concatenate(sides).astype(np.float32)
    host["quad_world"] = host["balloon_world"][host["quad_balloon"]]
    offset = scene.settings.contact_offset
    host["contact_offset"] = np.array(
        [offset if b.contact_offset is None else b.contact_offset for b in bodies], dtype=np.float32
    )
    host["contact_arc"] = np.array([b.contact_arc for b in bodies], dtype=np.float32)
    host["balloon_radius"] = np.array([b.radius for b in bodies], dtype=np.float32)
    host["gravity"] = np.tile(np.array([0.0, 0.0, -scene.settings.gravity], np.float32), (len(bodies), 1))
    for name, value in (
        ("drag", scene.settings.drag),
        ("friction", scene.settings.friction),
    ):
        host[name] = np.full(len(bodies), value, dtype=np.float32)


def _joined_corners(
    tables: list[NDArray[np.int32]], counts: list[int], first_quad: NDArray[np.int64]
) -> NDArray[np.int32]:
    """Join the corners of bodies: rows of all `counts` vertices first, then those to which they go on."""
    vertices = sum(counts)
    further = np.cumsum([0, *(len(table) - count for table, count in zip(tables, counts, strict=True))])
    joined = []
    for k, (table, count) in enumerate(zip(tables, counts, strict=True)):
        on = table - (vertices + further[k] - count)
        joined.append(np.where(table >= 0, table + 4 * first_quad[k], np.where(table == -1, -1, on)))
    own = [table[:count] for table, count in zip(joined, counts, strict=True)]
    more = [table[count:] for table, count in zip(joined, counts, strict=True)]
    return np.concatenate([*own, *more]).astype(np.int32)


def ring_arrays(scene: FlatBodies, host: Arrays) -> None:
    """Rings of the mesh, and the rings that can be held or closed ("joints")."""
    bodies, v = scene.bodies, scene.vertex_start
    ring_start = np.concatenate([[0], np.cumsum([len(b.mesh_rings) for b in bodies])])
    host["ring_first"] = np.array(
        [f + v[k] for k, b in enumerate(bodies) for f, _ in b.mesh_rings], dtype=np.int32
    )
    host["ring_around"] = np.array([n for b in bodies for _, n in b.mesh_rings], dtype=np.int32)
    host["vertex_ring"] = np.concatenate(
        [b.vertex_ring + ring_start[k] for k, b in enumerate(bodies)]
    ).astype(np.int32)
    host["quad_ring"] = np.concatenate(
        [b.vertex_ring[b.quads[:, 0]] + ring_start[k] for k, b in enumerate(bodies)]
    ).astype(np.int32)
    first = [r.first + v[k] for k, b in enumerate(bodies) for r in b.rings]
    around = [r.around for b in bodies for r in b.rings]
    # Device arrays are never empty: a scene without rings gets one that does nothing.
    host["joint_first"] = np.array(first or [0], dtype=np.int32)
    host["joint_around"] = np.array(around or [1], dtype=np.int32)
    host["joint_parts"] = np.array([r.parts for b in bodies for r in b.rings] or [False], dtype=np.int32)
    carried = [r.carried for b in bodies for r in b.rings]
    host["joint_carried"] = np.array(carried or [0], dtype=np.int32)
    vertex_joint = np.full(v[-1], -1, dtype=np.int32)
    for j, (f, n, before) in enumerate(zip(first, around, carried, strict=True)):
        vertex_joint[f - before : f + n] = j
    host["vertex_joint"] = vertex_joint
    necks = [_necks(b, int(scene.joint_start[k])) for k, b in enumerate(bodies)]
    neck = np.concatenate(necks).astype(np.int32)
    corners = neck[host["quads"]]
    host["vertex_neck"] = neck
    host["quad_neck"] = np.where((corners == corners[:, :1]).all(axis=1), corners[:, 0], -1).astype(np.int32)
    host["ring_cos_sin"] = np.zeros((v[-1], 2), dtype=np.float32)
    sizes = host["ring_around"].astype(np.int64)
    place = np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    turn = 2.0 * np.pi * place / np.repeat(sizes, sizes)
    vertices = np.repeat(host["ring_first"], sizes) + place
    host["ring_cos_sin"][vertices] = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    segment = np.full(v[-1], -1, dtype=np.int32)
    segment[host["quads"].reshape(-1)] = np.repeat(host["quad_segment"], 4)
    parting = (vertex_joint >= 0) & (host["joint_parts"][vertex_joint] == 1)
    host["vertex_segment"] = np.where(parting, -1, segment).astype(np.int32)
    mass = host["mass"]
    host["joint_mass"] = np.array(
        [mass[f : f + n].sum() for f, n in zip(first, around, strict=True)] or [1.0], dtype=np.float32
    )


def _necks(body: Body, first_joint: int) -> NDArray[np.int64]:
    """Return for every vertex of a body the joint in whose neck it lies, (V,), else -1."""
    parting = [i for i, ring in enumerate(body.rings) if ring.parts and ring.folds]
    if not parting:
        return np.full(len(body.along), -1)
    # Knot and lip lie in the neck of the knot.
    along = np.maximum(body.along, 0.0)
    away = np.abs(along[:, None] - along[[body.rings[i].first for i in parting]])
    nearest = away.shape[1] - 1 - away[:, ::-1].argmin(axis=1)
    joint: NDArray[np.int64] = np.array(parting)[nearest] + first_joint
    joint[away.min(axis=1) > NECK_REACH * body.radius] = -1
    return joint


def segment_arrays(scene: FlatBodies, host: Arrays) -> None:
    """Segments: runs of quads between the rings that part them."""
    quad, quad_end, origin, start_joint, end_joint = [], [], [], [], []
    sides = np.full((max(1, int(scene.joint_start[-1])), 2), -1, dtype=np.int32)
    for k, b in enumerate(scene.bodies):
        parting = [scene.joint_start[k] + i for i, r in enumerate(b.rings) if r.parts]
        if len(parting) != len(b.segment_ends) - 1:
            raise ValueError("every border between two segments needs its ring")
        begin = 0
        for i, end in enumerate(b.segment_ends):
            quad.append(begin + scene.quad_start[k])
            quad_end.append(end + scene.quad_start[k])
            origin.append(b.quads[begin, 0] + scene.vertex_start[k])
            start_joint.append(parting[i - 1] if i > 0 else -1)
            end_joint.append(parting[i] if i < len(parting) else -1)
            if i > 0:
                sides[parting[i - 1], 1] = len(quad) - 1
            if i < len(parting):
                sides[parting[i], 0] = len(quad) - 1
            begin = end
    host["segment_quad"], host["segment_quad_end"] = np.array(quad, np.int32), np.array(quad_end, np.int32)
    host["segment_origin"] = np.array(origin, np.int32)
    host["start_joint"], host["end_joint"] = np.array(start_joint, np.int32), np.array(end_joint, np.int32)
    # A ring that parts nothing lies within one segment.
    within = host["vertex_segment"][host["joint_first"]][:, None]
    host["joint_beside"] = np.where(sides < 0, np.maximum(within, 0), sides)


def chunk_arrays(scene: FlatBodies, host: Arrays) -> None:
    """Chunks: runs of at most 32 quads of one segment, the work of a warp; and where sculptures begin."""
    host["chunk_quad"], host["segment_chunk"] = chunks_of(host["segment_quad"], host["segment_quad_end"])
    host["chunk_origin"] = np.repeat(host["segment_origin"], np.diff(host["segment_chunk"]))
    for name, starts in (
        ("balloon", np.arange(len(scene.bodies) + 1)),
        ("vertex", scene.vertex_start),
        ("quad", scene.quad_start),
        ("chunk", host["segment_chunk"][scene.segment_start]),
        ("segment", scene.segment_start),
        ("joint", scene.joint_start),
    ):
        host[f"world_{name}"] = scene.by_world(starts)


def chunks_of(
    begin: NDArray[np.int32], end: NDArray[np.int32]
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Cut segments, from quad `begin` to `end` (S,) each, into chunks.

    Returns the first quad of every chunk (C + 1,), and the first chunk of every segment (S + 1,).
    """
    count = -(-(end - begin) // WARP)
    first = np.concatenate([[0], np.cumsum(count)]).astype(np.int32)
    within = np.arange(first[-1]) - np.repeat(first[:-1], count)
    starts = np.repeat(begin, count) + WARP * within
    return np.append(starts, end[-1]).astype(np.int32), first
