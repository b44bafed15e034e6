"""One picture and its scale."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Picture = npt.NDArray[np.uint8]


@dataclass(frozen=True)
class Shot:
    """One picture."""

    picture: Picture
    """(height, width, 3) rgb."""
    metres_per_pixel: float
    """Scale in the plane through the middle of the sculpture."""
