"""Gas in a closed triangle mesh and hands on it, for solvers that have neither."""

# mypy: disable-error-code="valid-type,attr-defined,index,no-untyped-def,no-untyped-call,call-overload"

import warp as wp


@wp.kernel
def add_volume(x: wp.array[wp.vec3], triangles: wp.array2d[int], volume: wp.array[float]):
    """Add up the volume (m3) inside a closed mesh."""
    t = wp.tid()
    a = x[triangles[t, 0]]
    b = x[triangles[t, 1]]
    c = x[triangles[t, 2]]
    wp.atomic_add(volume, 0, wp.dot(a, wp.cross(b, c)) / 6.0)


@wp.kernel
def press_wall(
    x: wp.array[wp.vec3],
    triangles: wp.array2d[int],
    volume: wp.array[float],
    sealed: float,
    atmosphere: float,
    force: wp.array[wp.vec3],
):
    """Add the force (N) of the gas on every vertex: `sealed` is pressure times volume (Pa m3) of the gas."""
    t = wp.tid()
    a = x[triangles[t, 0]]
    b = x[triangles[t, 1]]
    c = x[triangles[t, 2]]
    gauge = sealed / volume[0] - atmosphere
    share = wp.cross(b - a, c - a) * (gauge / 6.0)
    for k in range(3):
        wp.atomic_add(force, triangles[t, k], share)


@wp.kernel
def hold(
    held: wp.array[int],
    start: wp.array[wp.vec3],
    pinch: wp.array[wp.vec2],
    turn: wp.array[wp.vec2],
    fraction: float,
    x: wp.array[wp.vec3],
    v: wp.array[wp.vec3],
):
    """Put held vertices where hands have them: `start` (m), drawn to the axis and turned (radians) about it,
    a `fraction` of the way from where a frame begins to where it ends.
    """
    k = wp.tid()
    p = start[k]
    r = pinch[k][0] + fraction * (pinch[k][1] - pinch[k][0])
    angle = turn[k][0] + fraction * (turn[k][1] - turn[k][0])
    c = wp.cos(angle)
    s = wp.sin(angle)
    x[held[k]] = wp.vec3(p[0], r * (c * p[1] - s * p[2]), r * (s * p[1] + c * p[2]))
    v[held[k]] = wp.vec3(0.0)
