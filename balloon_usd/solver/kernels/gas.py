"""Gas: volumes of the segments between joints, the ideal gas law, the pump and the closing necks."""

import warp as wp


@wp.func
def patch_volume(x0: wp.vec3, x1: wp.vec3, x2: wp.vec3, x3: wp.vec3):
    """Return the volume (m3) between a bilinear patch and the origin: exact, middle . vector area / 3."""
    middle = 0.25 * (x0 + x1 + x2 + x3)
    return wp.dot(middle, wp.cross(x2 - x0, x3 - x1)) / 6.0


@wp.func
def share_of_volume(
    s: int,
    lane: int,
    lanes: int,
    quads: wp.array[wp.vec4i],
    segment_quad: wp.array[int],
    segment_quad_end: wp.array[int],
    o: wp.vec3,
    x: wp.array[wp.vec3],
):
    """Return a lane's share of the volume (m3) between a segment's wall and a point."""
    total = float(0.0)
    for q in range(segment_quad[s] + lane, segment_quad_end[s], lanes):
        c = quads[q]
        total += patch_volume(x[c[0]] - o, x[c[1]] - o, x[c[2]] - o, x[c[3]] - o)
    return total


@wp.func
def volume_of_fans(
    s: int,
    start_joint: wp.array[int],
    end_joint: wp.array[int],
    ring_middle: wp.array[wp.vec3],
    ring_area: wp.array[wp.vec3],
    o: wp.vec3,
):
    """Return the volume (m3) between a point and the flat fans that close a segment's ends."""
    caps = float(0.0)
    if start_joint[s] >= 0:
        caps -= wp.dot(ring_middle[start_joint[s]] - o, ring_area[start_joint[s]]) / 3.0
    if end_joint[s] >= 0:
        caps += wp.dot(ring_middle[end_joint[s]] - o, ring_area[end_joint[s]]) / 3.0
    return caps


@wp.kernel
def segment_volumes(
    quads: wp.array[wp.vec4i],
    segment_quad: wp.array[int],
    segment_quad_end: wp.array[int],
    segment_origin: wp.array[int],
    start_joint: wp.array[int],
    end_joint: wp.array[int],
    ring_middle: wp.array[wp.vec3],
    ring_area: wp.array[wp.vec3],
    x: wp.array[wp.vec3],
    volume: wp.array[float],
):
    """Write the volume (m3) of every segment, its open ends closed by flat fans; a fixed order of
    summation.
    """
    s, lane = wp.tid()
    o = x[segment_origin[s]]
    total = share_of_volume(s, lane, wp.block_dim(), quads, segment_quad, segment_quad_end, o, x)
    sums = wp.tile_sum(wp.tile(total))
    if lane == 0:
        volume[s] = sums[0] + volume_of_fans(s, start_joint, end_joint, ring_middle, ring_area, o)


OPEN_PASSAGE = 1.0
"""Passage (m2) of a joint that is not being closed: more than any neck."""
WIDE_OPEN = wp.constant(0.5 * OPEN_PASSAGE)


@wp.struct
class Air:
    """The gas around and inside."""

    atmosphere: float
    """Ambient pressure, Pa."""
    molar_energy: wp.float64
    """R T, J/mol."""
    density: float
    """Density, kg/m3."""
    discharge: float
    """Discharge coefficient of a neck."""
    equalise: float
    """Largest share of a pressure difference that a neck may even out in one substep."""


@wp.func
def advance_gas(
    b: int,
    balloon_segment: wp.array[int],
    balloon_segment_end: wp.array[int],
    end_joint: wp.array[int],
    inlet: wp.array[int],
    air: Air,
    dt: float,
    fraction: float,
    open_from: wp.array[float],
    open_to: wp.array[float],
    pump_flow: wp.array[float],
    pump_limit: wp.array[float],
    pump_goal: wp.array[wp.float64],
    volume: wp.array[float],
    amount: wp.array[wp.float64],
    pressure: wp.array[float],
):
    """Advance one balloon's gas: pump, flow through closing necks, gauge pressure (Pa) of every chamber.

    Segments whose common neck is fully open form one chamber of ideal, isothermal gas, p V = n R T; a neck
    that closes is an orifice. A chamber without gas of its own is open to the air (the nozzle's lip) and
    keeps its pressure.
    """
    first = balloon_segment[b]
    last = balloon_segment_end[b]
    begin = int(first)
    previous = int(-1)
    room_before = float(0.0)
    for s in range(first, last):
        joint = end_joint[s]
        passage = float(0.0)
        if joint >= 0:
            passage = open_from[joint] + fraction * (open_to[joint] - open_from[joint])
        if passage < WIDE_OPEN:
            room = float(0.0)
            gas = wp.float64(0.0)
            for k in range(begin, s + 1):
                room += volume[k]
                gas += amount[k]
            if begin <= inlet[b] and inlet[b] <= s:
                here = float(gas * air.molar_energy) / room - air.atmosphere
                if gas < pump_goal[b]:
                    inflow = wp.min(
                        pump_flow[b], pump_flow[b] * wp.max(pump_limit[b] - here, 0.0) / (0.1 * pump_limit[b])
                    )
                    added = wp.min(wp.float64(inflow * dt), pump_goal[b] - gas)
                    amount[inlet[b]] = amount[inlet[b]] + added
                    gas += added
            now = float(gas * air.molar_energy) / room - air.atmosphere
            if gas > wp.float64(0.0):
                for k in range(begin, s + 1):
                    pressure[k] = now
            if previous >= 0:
                neck = end_joint[previous]
                gap = open_from[neck] + fraction * (open_to[neck] - open_from[neck])
                if gap > 0.0:
                    difference = pressure[previous] - now
                    speed = wp.sqrt(2.0 * wp.abs(difference) / air.density)
                    blown = air.discharge * gap * speed * dt * (now + air.atmosphere)
                    # No more than a share of what would even out both chambers, were their walls rigid.
                    both = room_before * room / (room_before + room)
                    most = air.equalise * wp.abs(difference) * both
                    moved = wp.float64(wp.sign(difference) * wp.min(blown, most)) / air.molar_energy
                    amount[previous] = amount[previous] - moved
                    amount[s] = amount[s] + moved
            previous = s
            room_before = room
            begin = s + 1


@wp.kernel
def balloon_gas(
    balloon_segment: wp.array[int],
    balloon_segment_end: wp.array[int],
    end_joint: wp.array[int],
    inlet: wp.array[int],
    air: Air,
    dt: float,
    fraction: float,
    open_from: wp.array[float],
    open_to: wp.array[float],
    pump_flow: wp.array[float],
    pump_limit: wp.array[float],
    pump_goal: wp.array[wp.float64],
    volume: wp.array[float],
    amount: wp.array[wp.float64],
    pressure: wp.array[float],
):
    """Advance the gas of every balloon."""
    advance_gas(
        wp.tid(),
        balloon_segment,
        balloon_segment_end,
        end_joint,
        inlet,
        air,
        dt,
        fraction,
        open_from,
        open_to,
        pump_flow,
        pump_limit,
        pump_goal,
        volume,
        amount,
        pressure,
    )


@wp.func
def fan_gradient(arm: wp.vec3, chord: wp.vec3, area: wp.vec3, share: float):
    """Return the gradient (m2) of the volume on one side of a ring's fan by one of its vertices.

    `arm`: from the ring's middle to the vertex; `chord`: between its neighbours; `area`: of the fan;
    `share`: one over the ring's vertices.
    """
    return (0.5 * wp.cross(arm, chord) + share * area) / 3.0
