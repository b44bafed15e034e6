"""At home: a sculpture that one block has for itself lies, while a launch lasts, in the memory inside its
processor. Places, speeds, forces and lifts are there what arrays are elsewhere; their indices stay the same.
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native

NEAR = 512
"""Lanes of a block whose sculpture is at home; others have fewer."""
PLACE_BYTES = 12
"""Bytes of a vertex's place there, and of its speed."""
FORCE_BYTES = 48
"""Bytes of the forces on a quad's corners there, and of the lifts."""

AT_HOME = f"defined(__CUDA_ARCH__) && WP_TILE_BLOCK_DIM >= {NEAR}"
"""Where that is so, in the devices' language."""

_ADDRESS = f"""
#if {AT_HOME}
extern __shared__ char dynamic_smem_base[];
return (wp::uint64)(dynamic_smem_base + from_byte - (long long)first * {{size}});
#else
return (wp::uint64)values.data;
#endif
"""


@native(f"""
#if {AT_HOME}
return 1;
#else
return 0;
#endif
""")
def at_home() -> int:
    """Return 1 where sculptures are at home: known when the kernel is compiled."""
    return 0


@native(_ADDRESS.format(size=12))
def _start_of_vectors(values: wp.array[wp.vec3], first: int, from_byte: int) -> wp.uint64:
    """Return the address at which element 0 lies, or would lie."""
    return wp.uint64(first + from_byte + values.shape[0])


@native(_ADDRESS.format(size=4))
def _start_of_planes(values: wp.array2d[float], first: int, from_byte: int) -> wp.uint64:
    """Return the address at which item 0 lies, or would lie."""
    return wp.uint64(first + from_byte + values.shape[0])


@native(f"""
#if {AT_HOME}
return count;
#else
return values.shape[1];
#endif
""")
def _items(values: wp.array2d[float], count: int) -> int:
    """Return how many items lie side by side: those of a sculpture, `count`, or of all."""
    return count + values.shape[1]


@wp.func
def vectors_here(values: wp.array[wp.vec3], first: int, from_byte: int):
    """Return the array in which a sculpture's vectors stand while a launch lasts; `first`: its first."""
    return wp.array(ptr=_start_of_vectors(values, first, from_byte), shape=(values.shape[0],), dtype=wp.vec3)


@wp.func
def planes_here(values: wp.array2d[float], first: int, count: int, from_byte: int):
    """Return the planes in which a sculpture's items stand while a launch lasts; `first`: its first."""
    return wp.array(
        ptr=_start_of_planes(values, first, from_byte),
        shape=(values.shape[0], _items(values, count)),
        dtype=float,
    )


@wp.func
def take_room():
    """Take no room inside the processor: nobody is at home."""
