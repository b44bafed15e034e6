"""Device arrays of the thesis's model: springs, air particles and faces (Kosaka 2008)."""

import warp as wp

from balloon_usd.solver.kernels.arrays.rows import Constants, Drift
from balloon_usd.solver.kernels.arrays.table import array, array_struct
from balloon_usd.solver.kernels.device.warp_reduce import WARP


@array_struct
class Net:
    """Springs between vertices, and rings that are frozen."""

    constants: wp.array[Constants] = array("balloons", unit="SI", meaning="constants of springs and air")
    spring_ends: wp.array[wp.vec4i] = array("vertices", meaning="other ends of its springs; -1 for none")
    natural: wp.array[wp.vec4] = array("vertices", unit="m", meaning="natural lengths of its springs")
    joint_neck: wp.array[float] = array("joints", unit="m", meaning="radius of its neck when closed")
    frozen: wp.array[int] = array("joints", meaning="1 where its vertices have come together")
    spring_pull: wp.array[wp.vec3] = array("vertices", unit="m/s2", meaning="force of its springs")
    air_pull: wp.array[wp.vec3] = array("vertices", unit="m/s2", meaning="push of the air")


@array_struct
class Particles:
    """Particles of air."""

    air: wp.array[wp.vec3] = array("particles", unit="m", meaning="its position")
    air_speed: wp.array[wp.vec3] = array("particles", unit="m/s", meaning="its velocity")
    air_balloon: wp.array[int] = array("particles", meaning="its balloon")
    air_world: wp.array[int] = array("particles", meaning="its sculpture")
    air_cluster: wp.array[int] = array("particles", meaning="its cluster")
    air_push: wp.array[wp.vec3] = array("particles", unit="m/s2", meaning="repulsion by other particles")
    wall_push: wp.array[wp.vec3] = array("particles", unit="m/s2", meaning="push of the rubber")
    repairs: wp.array[int] = array("particles", meaning="how often it was brought back so far")
    fastest: wp.array[float] = array(1, unit="m/s", meaning="largest speed of all against their drift")
    neighbour_count: wp.array2d[int] = array("particles", WARP, meaning="neighbours that each lane has found")
    neighbours: wp.array2d[int] = array("particles", "slots for neighbours", meaning="these, lane by lane")
    air_face_count: wp.array2d[int] = array("particles", WARP, meaning="triangles that each lane has found")
    air_faces: wp.array2d[int] = array("particles", "slots for faces", meaning="these, lane by lane")
    most_near: wp.array[int] = array(
        "sculptures", meaning="slots that a list would have needed; 0: all had room"
    )


@array_struct
class Faces:
    """Triangles 2 q and 2 q + 1 of quad q, and clusters: bubbles whose rings are frozen."""

    quad_cluster: wp.array[int] = array("quads", meaning="its cluster, called by its last segment")
    balloon_quads: wp.array[int] = array("balloon starts", meaning="first quad")
    face_normal: wp.array[wp.vec3] = array("triangles", meaning="outward unit normal")
    face_angles: wp.array[wp.vec3] = array("triangles", unit="rad", meaning="its angles")
    face_push: wp.array[wp.vec3] = array("triangles", meaning="push of the air on its vertices, in pushes")
    face_hits: wp.array[float] = array("triangles", meaning="particles that have pushed on it in this frame")
    face_air_count: wp.array2d[int] = array("quads", WARP, meaning="particles that each lane has found")
    face_air: wp.array2d[int] = array("quads", "slots for particles", meaning="these, lane by lane")
    drifts: wp.array[Drift] = array("segments", unit="SI", meaning="how the cluster of that name drifts")
    pressure_per_hit: wp.array[float] = array(
        "balloons", unit="Pa m2", meaning="pressure of one particle on an area"
    )
    cluster_pressure: wp.array[float] = array("segments", unit="Pa", meaning="gauge pressure of that cluster")
