"""How far points are from a surface."""

import warp as wp


@wp.kernel
def distances_to(mesh: wp.uint64, points: wp.array[wp.vec3], reach: float, distances: wp.array[wp.float32]):
    """Measure the distance of each point to the nearest place of a mesh, at most `reach`."""
    i = wp.tid()
    distances[i] = reach
    found = wp.mesh_query_point_no_sign(mesh, points[i], reach)
    if found.result:
        place = wp.mesh_eval_position(mesh, found.face, found.u, found.v)
        distances[i] = wp.length(points[i] - place)
