"""Particles of air as the preview draws them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from balloon_usd.preview.subdivide import Points


@dataclass(frozen=True)
class Particles:
    """Balls at one moment."""

    centres: Points
    """(P, 3) m, z up."""
    radii: npt.NDArray[np.float32]
    """(P,) m."""
    colors: npt.NDArray[np.float32]
    """(P, 3) linear rgb."""

    @classmethod
    def none(cls) -> Particles:
        """Return no particles."""
        return cls(*(np.zeros(shape, dtype=np.float32) for shape in ((0, 3), 0, (0, 3))))

    @classmethod
    def joined(cls, parts: Sequence[Particles]) -> Particles:
        """Return the particles of several clouds as one."""
        parts = parts or [cls.none()]
        return cls(*(np.concatenate(rows) for rows in zip(*(p.arrays for p in parts), strict=True)))

    @property
    def arrays(self) -> tuple[Points, npt.NDArray[np.float32], npt.NDArray[np.float32]]:
        """Centres, radii and colours."""
        return self.centres, self.radii, self.colors

    @property
    def bounds(self) -> Points:
        """Two corners of the box round each ball, (2P, 3) m."""
        reach = self.radii[:, None]
        return np.concatenate([self.centres - reach, self.centres + reach])
