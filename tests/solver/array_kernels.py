"""Kernels that read and write arrays as the solver's do, for tests."""

import warp as wp

from balloon_usd.solver.kernels.device.array_access import (
    float_at,
    int_at,
    int_in,
    mat22_at,
    put_float,
    put_vec3,
    vec2_at,
    vec2i_at,
    vec3_at,
    vec4_at,
    vec4i_at,
)
from balloon_usd.solver.kernels.device.coherent_load import coherent_float, coherent_vec2, coherent_vec3
from balloon_usd.solver.kernels.device.soa import load_soa, store_soa


@wp.kernel
def compare_readings(
    whole: wp.array[int],
    table: wp.array2d[int],
    pairs: wp.array[wp.vec2i],
    fours: wp.array[wp.vec4i],
    number: wp.array[float],
    two: wp.array[wp.vec2],
    three: wp.array[wp.vec3],
    four: wp.array[wp.vec4],
    matrix: wp.array[wp.mat22],
    same: wp.array[int],
):
    """Count which ways of reading an element give what Warp's own gives."""
    i = wp.tid()
    count = 0
    count += wp.where(int_at(whole, i) == whole[i], 1, 0)
    count += wp.where(int_in(table, i, 1) == table[i, 1], 1, 0)
    count += wp.where(vec2i_at(pairs, i) == pairs[i], 1, 0)
    count += wp.where(vec4i_at(fours, i) == fours[i], 1, 0)
    count += wp.where(float_at(number, i) == number[i], 1, 0)
    count += wp.where(vec2_at(two, i) == two[i], 1, 0)
    count += wp.where(vec3_at(three, i) == three[i], 1, 0)
    count += wp.where(vec4_at(four, i) == four[i], 1, 0)
    count += wp.where(mat22_at(matrix, i) == matrix[i], 1, 0)
    count += wp.where(coherent_float(number, i, 0) == number[i], 1, 0)
    count += wp.where(coherent_vec2(two, i, 0) == two[i], 1, 0)
    count += wp.where(coherent_vec3(three, i, 0) == three[i], 1, 0)
    same[i] = count


@wp.kernel
def double(number: wp.array[float], three: wp.array[wp.vec3]):
    """Double every element."""
    i = wp.tid()
    put_float(number, i, 2.0 * float_at(number, i))
    put_vec3(three, i, 2.0 * vec3_at(three, i))


@wp.kernel
def through_soa(given: wp.array2d[wp.vec3], planes: wp.array2d[float], found: wp.array2d[wp.vec3]):
    """Store all vectors of every item in planes and load them again, the last one first."""
    item = wp.tid()
    for k in range(given.shape[1]):
        store_soa(planes, item, k, given[item, k])
    for k in range(given.shape[1]):
        last = given.shape[1] - 1 - k
        found[item, last] = load_soa(planes, item, last, 0)
