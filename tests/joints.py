"""Where the joints of a finished sculpture lie, free of how it has drifted and turned as a whole."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.frame import Frame
from balloon_usd.solver.simulation import Simulation


def joint_distances(simulation: Simulation, frame: Frame) -> NDArray[np.float64]:
    """Distances between the joints of the first sculpture, knots among them, one for every pair, m."""
    names = list(simulation.plans[0].strips)
    joints = []
    for ring in simulation.plans[0].table.rings:
        if ring.joint:
            balloon = names.index(ring.balloon)
            mesh = simulation.meshes[0][balloon]
            first = mesh.ring_start[mesh.ring_at(ring.along)]
            joints.append(frame.points[balloon][first : first + mesh.around].mean(axis=0, dtype=np.float64))
    one, other = np.triu_indices(len(joints), 1)
    places = np.array(joints)
    return np.linalg.norm(places[one] - places[other], axis=1)
