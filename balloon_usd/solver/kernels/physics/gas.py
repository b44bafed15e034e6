"""Gas: volumes of the segments between joints, the ideal gas law, the pump and the closing necks."""

import warp as wp

from balloon_usd.solver.kernels.arrays.latex import Chambers
from balloon_usd.solver.kernels.arrays.rows import Air
from balloon_usd.solver.kernels.arrays.shared import Joints, Mesh, State
from balloon_usd.solver.kernels.device.array_access import float_at, int_at, put_float, vec3_at, vec4i_at
from balloon_usd.solver.kernels.device.barrier import warp_barrier
from balloon_usd.solver.kernels.device.coherent_load import coherent_float, coherent_vec3


@wp.func
def patch_volume(x0: wp.vec3, x1: wp.vec3, x2: wp.vec3, x3: wp.vec3):
    """Return the volume (m3) between a bilinear patch and the origin: exact, middle . vector area / 3."""
    middle = 0.25 * (x0 + x1 + x2 + x3)
    return wp.dot(middle, wp.cross(x2 - x0, x3 - x1)) / 6.0


@wp.func
def volume_of_fans(
    s: int,
    start_joint: wp.array[int],
    end_joint: wp.array[int],
    ring_middle: wp.array[wp.vec3],
    ring_area: wp.array[wp.vec3],
    o: wp.vec3,
    shared: int,
):
    """Return the volume (m3) between a point and the flat fans that close a segment's ends."""
    start = int_at(start_joint, s)
    end = int_at(end_joint, s)
    # Branch-free: clamp the index, load, then mask; the loads need not wait for the test.
    first = wp.max(start, 0)
    last = wp.max(end, 0)
    begins = wp.dot(coherent_vec3(ring_middle, first, shared) - o, coherent_vec3(ring_area, first, shared))
    ends = wp.dot(coherent_vec3(ring_middle, last, shared) - o, coherent_vec3(ring_area, last, shared))
    return (wp.where(end >= 0, ends, 0.0) - wp.where(start >= 0, begins, 0.0)) / 3.0


@wp.func
def shares_of_chunks(c: int, apart: int, end: int, chunk_share: wp.array[float], shared: int):
    """Return the volume (m3) of four chunks at a stride `apart`, those below `end`: four loads in flight."""
    # Branch-free, as above.
    a = coherent_float(chunk_share, wp.min(c, end - 1), shared)
    b = coherent_float(chunk_share, wp.min(c + apart, end - 1), shared)
    d = coherent_float(chunk_share, wp.min(c + 2 * apart, end - 1), shared)
    e = coherent_float(chunk_share, wp.min(c + 3 * apart, end - 1), shared)
    total = wp.where(c < end, a, 0.0) + wp.where(c + apart < end, b, 0.0)
    return total + (wp.where(c + 2 * apart < end, d, 0.0) + wp.where(c + 3 * apart < end, e, 0.0))


@wp.kernel
def segment_volumes(mesh: Mesh, joints: Joints, state: State):
    """Write the volume (m3) of every segment, its open ends closed by flat fans; a fixed order of
    summation.
    """
    s, lane = wp.tid()
    o = vec3_at(state.x, int_at(mesh.segment_origin, s))
    total = float(0.0)
    for q in range(int_at(mesh.segment_quad, s) + lane, int_at(mesh.segment_quad_end, s), wp.block_dim()):
        c = vec4i_at(mesh.quads, q)
        total += patch_volume(
            vec3_at(state.x, c[0]) - o,
            vec3_at(state.x, c[1]) - o,
            vec3_at(state.x, c[2]) - o,
            vec3_at(state.x, c[3]) - o,
        )
    sums = wp.tile_sum(wp.tile(total))
    if lane == 0:
        put_float(
            state.volume,
            s,
            sums[0]
            + volume_of_fans(s, mesh.start_joint, mesh.end_joint, joints.ring_middle, joints.ring_area, o, 0),
        )


OPEN_PASSAGE = 1.0
"""Passage (m2) of a joint that is not being closed: more than any neck."""
WIDE_OPEN = 0.5 * OPEN_PASSAGE
"""Passage (m2) from which segments on both sides of a joint form one chamber."""
LEAST_VOLUME = wp.constant(1.0e-12)
"""Volume of two chambers below which no gas flows between them, m3."""
HIGHEST_PRESSURE = wp.constant(1.5e5)
"""Largest gauge pressure of a chamber, Pa, that of gas squeezed to two fifths: what has turned inside out is
blown up with it again. The air in a knot between joints went below no volume, to minus one atmosphere, and
the knot was soon larger than the figure.
"""


@wp.func
def passage_of(joint: int, fraction: float, open_from: wp.array[float], open_to: wp.array[float]):
    """Return the open area (m2) of a joint."""
    return float_at(open_from, joint) + fraction * (float_at(open_to, joint) - float_at(open_from, joint))


@wp.func
def pressure_of(gas: wp.float64, space: float, air: Air):
    """Return the gauge pressure (Pa) of gas (mol) in a space (m3): ideal, isothermal, p V = n R T."""
    energy = float(gas * air.molar_energy)
    return energy / wp.max(space, energy / (air.atmosphere + HIGHEST_PRESSURE)) - air.atmosphere


@wp.func
def without_guests(s: int, chambers: Chambers, state: State):
    """Return the volume (m3) of the gas in a segment, and write it, where other balloons lie in it."""
    first = int_at(chambers.first_guest, s)
    last = int_at(chambers.first_guest, s + 1)
    space = float_at(state.volume, s)
    if first < last:
        for n in range(first, last):
            space -= float_at(state.volume, int_at(chambers.guests, n))
        put_float(state.volume, s, space)
    return space


@wp.func
def pumped(gas: wp.float64, gauge: float, flow: float, limit: float, goal: wp.float64, dt: float):
    """Return the gas (mol) that a pump brings in a substep into a chamber with so much at a gauge pressure
    (Pa), up to a goal; or, where its flow (mol/s) is negative, that is let out, down to that.
    """
    missing = goal - gas
    added = wp.float64(0.0)
    if flow >= 0.0 and missing > wp.float64(0.0):
        inflow = wp.min(flow, flow * wp.max(limit - gauge, 0.0) / (0.1 * limit))
        added = wp.min(wp.float64(inflow * dt), missing)
    if flow < 0.0 and missing < wp.float64(0.0):
        added = wp.max(wp.float64(flow * dt), missing)
    return added


@wp.func
def press_chamber(
    s: int,
    begin: int,
    end: int,
    into: int,
    air: Air,
    dt: float,
    pump_flow: float,
    pump_limit: float,
    pump_goal: wp.float64,
    chambers: Chambers,
    state: State,
):
    """Where a chamber of segments begins, pump gas into it, or let it out, and write its volume (m3) and
    gauge pressure (Pa).

    A chamber without gas of its own is open to the air (the nozzle's lip) and keeps its pressure. What lies
    in a chamber leaves so much less room, and feels how much more pressure it has than that.
    """
    if begin == s:
        host = int_at(chambers.host_segment, s)
        outside = wp.where(host >= 0, float_at(chambers.pressure, wp.max(host, 0)), 0.0)
        space = without_guests(s, chambers, state)
        gas = chambers.amount[s]
        for k in range(begin + 1, end + 1):
            space += without_guests(k, chambers, state)
            gas += chambers.amount[k]
        if begin <= into and into <= end and gas != pump_goal:
            here = pressure_of(gas, space, air) - outside
            added = pumped(gas, here, pump_flow, pump_limit, pump_goal, dt)
            chambers.amount[into] = chambers.amount[into] + added
            gas += added
        if gas > wp.float64(0.0):
            now = pressure_of(gas, space, air) - outside
            for k in range(begin, end + 1):
                put_float(chambers.pressure, k, now)
        put_float(chambers.chamber_volume, end, space)


@wp.func
def blow_through(
    s: int,
    end: int,
    gap: float,
    air: Air,
    dt: float,
    chamber_volume: wp.array[float],
    pressure: wp.array[float],
):
    """Return the gas (mol) that flows in a substep through a neck, an orifice of area `gap` (m2), from the
    chamber that ends with segment `s` into the one that ends with segment `end`.
    """
    difference = float_at(pressure, s) - float_at(pressure, end)
    speed = wp.sqrt(2.0 * wp.abs(difference) / air.density)
    blown = air.discharge * gap * speed * dt * (float_at(pressure, end) + air.atmosphere)
    # No more than a share of what would even out both chambers, were their walls rigid; nothing where one has
    # gone through itself.
    one = wp.max(float_at(chamber_volume, s), 0.0)
    other = wp.max(float_at(chamber_volume, end), 0.0)
    both = one * other / wp.max(one + other, LEAST_VOLUME)
    most = air.equalise * wp.abs(difference) * both
    return wp.float64(wp.sign(difference) * wp.min(blown, most)) / air.molar_energy


@wp.func
def advance_gas(
    b: int,
    lane: int,
    lanes: int,
    air: Air,
    dt: float,
    fraction: float,
    chambers: Chambers,
    state: State,
):
    """Advance one balloon's gas: pump, gauge pressure (Pa) of every chamber, flow through closing necks.

    Segments whose common neck is fully open form one chamber; a neck that closes is an orifice.
    `blowing`: 1 where a balloon has such a neck.
    """
    first = int_at(chambers.balloon_segment, b)
    last = int_at(chambers.balloon_segment_end, b)
    blows = int_at(chambers.blowing, b)
    into = int_at(chambers.inlet, b)
    inflow = float_at(chambers.pump_flow, b)
    limit = float_at(chambers.pump_limit, b)
    wanted = chambers.pump_goal[b]
    for s in range(first + lane, last, lanes):
        begin = int_at(chambers.chamber_first, s)
        end = int_at(chambers.chamber_last, s)
        press_chamber(s, begin, end, into, air, dt, inflow, limit, wanted, chambers, state)
    if blows == 0:
        return
    warp_barrier()
    for e in range(int_at(chambers.balloon_edge, b) + lane, int_at(chambers.balloon_edge, b + 1), lanes):
        source = int_at(chambers.flow_from, e)
        sink = int_at(chambers.flow_to, e)
        chambers.flow[e] = wp.float64(0.0)
        if source != sink:
            neck = int_at(chambers.flow_joint, e)
            gap = passage_of(neck, fraction, chambers.open_from, chambers.open_to)
            if gap > 0.0:
                chambers.flow[e] = blow_through(
                    source, sink, gap, air, dt, chambers.chamber_volume, chambers.pressure
                )
            chambers.flow[e] = chambers.flow[e] + wp.float64(float_at(chambers.neck_flow, neck) * dt)
    warp_barrier()
    for s in range(first + lane, last, lanes):
        # Gas of a chamber comes and goes in its last segment.
        for n in range(int_at(chambers.chamber_end, s), int_at(chambers.chamber_end, s + 1)):
            end_of = int_at(chambers.flow_ends, n)
            flow = chambers.flow[wp.abs(end_of) - 1]
            chambers.amount[s] = chambers.amount[s] + wp.where(end_of > 0, flow, -flow)


@wp.func
def fan_gradient(arm: wp.vec3, chord: wp.vec3, area: wp.vec3, share: float):
    """Return the gradient (m2) of the volume on one side of a ring's fan by one of its vertices.

    `arm`: from the ring's middle to the vertex; `chord`: between its neighbours; `area`: of the fan;
    `share`: one over the ring's vertices.
    """
    return (0.5 * wp.cross(arm, chord) + share * area) / 3.0
