"""What hands carry along when they move rings."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]


class Carried(NamedTuple):
    """Joints that hang on rings that hands move: each goes as far as the ring that it hangs on."""

    joints: Ints
    """Of the scene, (M,)."""
    by: Ints
    """Which of the moved rings carries each, (M,)."""
    places: Floats
    """Where they were, (M, 3), m."""

    def goals(self, shifts: Floats) -> Floats:
        """Return where they go, (M, 3), m; `shifts`: how far the moved rings have gone, (N, 3), m."""
        return self.places + shifts[self.by]
