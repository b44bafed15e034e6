"""Shared memory of a block as arrays with the indices that they have in global memory.

The kernel reserves the memory; on a CPU there is none.
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native

VERTEX_BYTES = 12
"""Bytes of a vertex's position, and of its velocity."""
QUAD_BYTES = 48
"""Bytes of the forces on a quad's four corners, and of the volume gradients."""

_ADDRESS = """
#if defined(__CUDA_ARCH__)
extern __shared__ char dynamic_smem_base[];
return (wp::uint64)(dynamic_smem_base + from_byte - (long long)first * {size});
#else
return (wp::uint64)values.data;
#endif
"""


@native(_ADDRESS.format(size=12))
def _vectors_address(values: wp.array[wp.vec3], first: int, from_byte: int) -> wp.uint64:
    """Return the address of element 0, which lies before the sculpture's own."""
    return wp.uint64(first + from_byte + values.shape[0])


@native(_ADDRESS.format(size=4))
def _soa_address(values: wp.array2d[float], first: int, from_byte: int) -> wp.uint64:
    """Return the address of item 0, likewise."""
    return wp.uint64(first + from_byte + values.shape[0])


@wp.func
def shared_vectors(values: wp.array[wp.vec3], first: int, from_byte: int):
    """Return a sculpture's vectors in shared memory, from a byte on; `first`: index of its first vector."""
    return wp.array(ptr=_vectors_address(values, first, from_byte), shape=(values.shape[0],), dtype=wp.vec3)


@wp.func
def shared_soa(values: wp.array2d[float], first: int, count: int, from_byte: int):
    """Return the planes of a sculpture's `count` items in shared memory, from a byte on; `first`: index of
    its first item.
    """
    return wp.array(ptr=_soa_address(values, first, from_byte), shape=(values.shape[0], count), dtype=float)
