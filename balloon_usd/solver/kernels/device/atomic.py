"""Atomic sums and exchanges of integers. Warp's own are atomic on a GPU only: on a CPU it launches kernels by
one thread, while here a team may share them.
"""

import warp as wp

from balloon_usd.solver.kernels.device.native import native


def _either(gpu: str, cpu: str) -> str:
    """Return the C++ snippet that does one thing on a GPU and another on a CPU."""
    return f"""
#if defined(__CUDA_ARCH__)
{gpu}
#else
{cpu}
#endif
"""


def _add_each(numbers: int) -> str:
    """Return the C++ snippet that adds to each of so many ints of a vector."""
    return f"for (int k = 0; k < {numbers}; ++k) " + _either(
        "atomicAdd(&values.data[i].c[k], value.c[k]);",
        "__atomic_fetch_add(&values.data[i].c[k], value.c[k], __ATOMIC_RELAXED);",
    )


@native(
    _either(
        "return atomicAdd(values.data + i, value);",
        "return __atomic_fetch_add(values.data + i, value, __ATOMIC_RELAXED);",
    )
)
def add_int(values: wp.array[int], i: int, value: int) -> int:  # noqa: ARG001  # in the native code
    """Add to an int, and return what it was."""
    return values[i]


@native(
    _either(
        "return atomicExch(values.data + i, value);",
        "return __atomic_exchange_n(values.data + i, value, __ATOMIC_RELAXED);",
    )
)
def exchange_int(values: wp.array[int], i: int, value: int) -> int:  # noqa: ARG001  # likewise
    """Replace an int, and return what it was."""
    return values[i]


@native(_add_each(3))
def add_vec3i(values: wp.array[wp.vec3i], i: int, value: wp.vec3i):
    """Add to each of three ints."""
    ...


@native(_add_each(4))
def add_vec4i(values: wp.array[wp.vec4i], i: int, value: wp.vec4i):
    """Add to each of four ints."""
    ...
