"""The momentum of a sculpture that hands loosen their grip on: nothing outside acts on it, so it has none.

Walls that are kept apart move without regard to it: three ears of a 646 flew off at 1.8 m/s.
"""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Crossings
from balloon_usd.solver.kernels.arrays.shared import Balloons, Hands, Mesh, Sculptures, State
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, vec3_at
from balloon_usd.solver.kernels.device.warp_reduce import warp_sum, warp_sum3
from balloon_usd.solver.kernels.physics.untangling import NOT_LOOKED


@wp.func
def inertia_of(squares: wp.vec3, products: wp.vec3):
    """Return the tensor of inertia (kg m2), given sums of mass times x2, y2, z2 and times yz, zx, xy."""
    return wp.mat33(
        squares[1] + squares[2], -products[2], -products[1],
        -products[2], squares[2] + squares[0], -products[0],
        -products[1], -products[0], squares[0] + squares[1],
    )  # fmt: skip


@wp.func
def has_none(world: int, sculptures: Sculptures, balloons: Balloons, hands: Hands, crossings: Crossings):
    """Return whether a sculpture floats whose walls can touch, and were kept apart now."""
    first = int_at(sculptures.world_balloon, world)
    if int_at(hands.floating, first) == 0 or int_at(crossings.untangling_round, world) == NOT_LOOKED:
        return False
    for balloon in range(first, int_at(sculptures.world_balloon, world + 1)):
        if int_at(balloons.touching, balloon) > 0:
            return True
    return False


@wp.kernel
def measure_momentum(
    sculptures: Sculptures,
    mesh: Mesh,
    balloons: Balloons,
    hands: Hands,
    crossings: Crossings,
    state: State,
):
    """Write the middle of mass (m), its velocity (m/s) and the spin (rad/s) of every sculpture that has no
    momentum; a warp of lanes each on a GPU.
    """
    world, lane = wp.tid()
    lanes = wp.block_dim()
    if not has_none(world, sculptures, balloons, hands, crossings):
        return
    first = int_at(sculptures.world_vertex, world)
    end = int_at(sculptures.world_vertex, world + 1)
    # Places relative to one of them: sums of small numbers keep their digits.
    near = vec3_at(state.x, first)
    mass = float(0.0)
    middle = wp.vec3(0.0)
    velocity = wp.vec3(0.0)
    for i in range(first + lane, end, lanes):
        m = float_at(mesh.mass, i)
        mass += m
        middle += m * (vec3_at(state.x, i) - near)
        velocity += m * vec3_at(state.v, i)
    mass = warp_sum(mass)
    middle = near + warp_sum3(middle, lanes) / mass
    angular = wp.vec3(0.0)
    squares = wp.vec3(0.0)
    products = wp.vec3(0.0)
    for i in range(first + lane, end, lanes):
        m = float_at(mesh.mass, i)
        arm = vec3_at(state.x, i) - middle
        angular += m * wp.cross(arm, vec3_at(state.v, i))
        squares += m * wp.cw_mul(arm, arm)
        products += m * wp.vec3(arm[1] * arm[2], arm[2] * arm[0], arm[0] * arm[1])
    velocity = warp_sum3(velocity, lanes) / mass
    angular = warp_sum3(angular, lanes)
    inertia = inertia_of(warp_sum3(squares, lanes), warp_sum3(products, lanes))
    if lane == 0:
        sculptures.middle[world] = middle
        sculptures.velocity[world] = velocity
        sculptures.spin[world] = wp.inverse(inertia) * angular


@wp.kernel
def take_momentum(
    sculptures: Sculptures, mesh: Mesh, balloons: Balloons, hands: Hands, crossings: Crossings, state: State
):
    """Take the momentum and the angular momentum from every sculpture whose were measured."""
    i = wp.tid()
    world = int_at(balloons.balloon_world, int_at(mesh.vertex_balloon, i))
    if not has_none(world, sculptures, balloons, hands, crossings):
        return
    arm = vec3_at(state.x, i) - vec3_at(sculptures.middle, world)
    state.v[i] -= vec3_at(sculptures.velocity, world) + wp.cross(vec3_at(sculptures.spin, world), arm)
