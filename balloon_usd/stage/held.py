"""Samples of what seldom changes: a value is written where it changes and holds until the next one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Sdf
from balloon_usd.stage.animated import BY_CLUSTER

if TYPE_CHECKING:
    from numpy.typing import NDArray


class HeldSamples:
    """What the clusters of one balloon's air decide; without a change there is no sample."""

    def __init__(self, layer: Any, prim: Any) -> None:
        """Prepare for the prim at a path of a layer."""
        self._layer, self._prim = layer, prim
        self._cluster: NDArray[np.int32] | None = None
        self._last = 0
        """Time code of the last sample, or of the first frame."""

    def write(self, time_code: int, cluster: NDArray[np.int32]) -> None:
        """Take the clusters (P,) of one frame, which are kept and must not change."""
        held, self._cluster = self._cluster, cluster
        if held is None:
            self._last = time_code
        elif not np.array_equal(held, cluster):
            self._change(time_code, held, cluster)

    def _change(self, time_code: int, held: NDArray[np.int32], cluster: NDArray[np.int32]) -> None:
        prim = self._layer.GetPrimAtPath(self._prim)
        for by_cluster in BY_CLUSTER:
            attribute = prim.attributes.get(by_cluster.name)
            if not attribute:
                attribute = Sdf.AttributeSpec(prim, by_cluster.name, by_cluster.type_name)
                self._layer.SetTimeSample(attribute.path, self._last, by_cluster.read(held))
            if by_cluster.blends and self._last < time_code - 1:
                self._layer.SetTimeSample(attribute.path, time_code - 1, by_cluster.read(held))
            self._layer.SetTimeSample(attribute.path, time_code, by_cluster.read(cluster))
        self._last = time_code
