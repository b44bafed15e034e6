"""The table of all device arrays: what each holds, and from that its memory, its struct and its page."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, TypeVar, cast

import warp as wp

Size = Literal[
    "balloon starts",
    "balloons",
    "chunk starts",
    "chunks",
    "contacts",
    "corner rows",
    "curve segments",
    "flow edges",
    "flow ends",
    "guests",
    "joints",
    "packed vertices",
    "packing rings",
    "particles",
    "quad starts",
    "quads",
    "rings",
    "sculpture starts",
    "sculptures",
    "segment starts",
    "segments",
    "slots for faces",
    "slots for neighbours",
    "slots for particles",
    "slots for struts",
    "spins",
    "struts",
    "triangles",
    "vertices",
    "welds",
]
"""Sizes of a scene. Starts are one more than what starts there: the end of the last."""


@dataclass(frozen=True)
class ArraySpec:
    """One device array of a scene."""

    name: str
    struct: str
    """Name of the struct in which kernels take it."""
    dtype: Any
    """Warp's type of an element."""
    shape: tuple[Size | int, ...]
    unit: str
    """Unit of the elements; empty for counts, indices and shares."""
    meaning: str

    @property
    def type_name(self) -> str:
        """Name of the type of an element, for the reader."""
        name = getattr(self.dtype, "key", None) or self.dtype.__name__
        if name == "mat_t":
            name = "mat " + " x ".join(map(str, self.dtype._shape_))
        return {"int32": "int", "float32": "float"}.get(name, name.removesuffix("f"))


ARRAYS: dict[str, ArraySpec] = {}
"""All device arrays by name."""
STRUCTS: dict[str, Any] = {}
"""The structs of them by name."""

Struct = TypeVar("Struct")


@dataclass(frozen=True)
class _Row:
    """What is said of an array besides its name and type."""

    shape: tuple[Size | int, ...]
    unit: str
    meaning: str


def array(*shape: Size | int, unit: str = "", meaning: str) -> Any:
    """Declare a field of a struct as a device array of this shape."""
    return _Row(shape, unit, meaning)


def array_struct(cls: type[Struct]) -> type[Struct]:
    """Make a class whose fields are declared by `array` a struct for kernels, and enter them in the table.

    Raises:
        ValueError: another struct has an array of that name.
        TypeError: a shape has another number of dimensions than the type of its field.
    """
    struct: Any = wp.struct(cls)
    for name, field in struct.vars.items():
        row = getattr(cls, name)
        if name in ARRAYS:
            raise ValueError(f"{cls.__name__}.{name}: {ARRAYS[name].struct} has an array of that name")
        if len(row.shape) != field.type.ndim:
            raise TypeError(f"{cls.__name__}.{name}: {field.type.ndim} dimensions, but shape {row.shape}")
        ARRAYS[name] = ArraySpec(name, cls.__name__, field.type.dtype, row.shape, row.unit, row.meaning)
    STRUCTS[cls.__name__] = made = cast("type[Struct]", struct)
    return made
