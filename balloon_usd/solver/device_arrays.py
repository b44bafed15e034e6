"""The device arrays of a scene, made as their table says, and the structs in which kernels take them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import warp as wp

from balloon_usd.solver.kernels.arrays.table import ARRAYS, STRUCTS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from balloon_usd.solver.kernels.arrays.table import Size

    DeviceArray = wp.array[Any]


class DeviceArrays(dict[str, "DeviceArray"]):
    """Arrays of one scene by their names in the table."""

    def __init__(self, device: str, sizes: Mapping[Size, int]) -> None:
        """Make none yet; `sizes`: of the scene, as far as they are known before its first arrays."""
        super().__init__()
        self._device = device
        self._sizes: dict[Size, int] = dict(sizes)
        self._structs: dict[str, Any] = {}

    def __setitem__(self, name: str, array: DeviceArray) -> None:
        """Take an array; structs that are asked for from now on have it.

        Raises:
            KeyError: the table has no array of that name.
        """
        self._structs.pop(ARRAYS[name].struct, None)
        super().__setitem__(name, array)

    def set_size(self, size: Size, count: int) -> None:
        """Set a size that no array of the host tells."""
        self._sizes[size] = count

    def put(self, host: Mapping[str, NDArray[Any]]) -> None:
        """Copy host arrays to the device; a size that is not known yet is taken from the first array that
        has it.

        Raises:
            KeyError: the table has no array of that name.
            ValueError: an array has another shape than the table says.
        """
        for name, values in host.items():
            made: DeviceArray = wp.array(values, dtype=ARRAYS[name].dtype, device=self._device)
            self._check(name, made.shape)
            self[name] = made

    def fill(self, name: str, value: Any) -> None:
        """Make an array of equal elements."""
        spec = ARRAYS[name]
        self[name] = wp.full(self.shape(name), value, dtype=spec.dtype, device=self._device)

    def zero_others(self, *structs: Any) -> None:
        """Make the arrays of structs that there are not yet, of zeros."""
        for name in (name for struct in structs for name in struct.vars if name not in self):
            self[name] = wp.zeros(self.shape(name), dtype=ARRAYS[name].dtype, device=self._device)

    def shape(self, name: str) -> tuple[int, ...]:
        """Return the shape of an array.

        Raises:
            KeyError: a size of it is not known yet.
        """
        return tuple(n if isinstance(n, int) else self._sizes[n] for n in ARRAYS[name].shape)

    def struct(self, kind: Any) -> Any:
        """Return a struct of arrays for launches, always the same while no array is replaced.

        Raises:
            KeyError: this scene lacks an array of the struct.
        """
        if kind.key not in self._structs:
            struct = kind()
            for name in kind.vars:
                setattr(struct, name, self[name])
            self._structs[kind.key] = struct
        return self._structs[kind.key]

    def argument(self, name: str, kind: Any) -> Any:
        """Return what a kernel takes as an argument of this name and type: a struct, or an array.

        Raises:
            KeyError: this scene has no such array.
        """
        return self.struct(kind) if kind in STRUCTS.values() else self[name]

    def _check(self, name: str, shape: tuple[int, ...]) -> None:
        """Compare the shape of a new array with the table."""
        for size, n in zip(ARRAYS[name].shape, shape, strict=True):
            known = size if isinstance(size, int) else self._sizes.setdefault(size, n)
            if known != n:
                raise ValueError(f"{name} has the shape {shape}: expected {known} {size}, as the table says")
