"""What can go wrong in a simulation."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence


class SimulationFailed(Exception):  # noqa: N818
    """The physics of a sculpture broke down; the message says when, during what, and why."""

    def __init__(self, step: str, time: float, cause: str) -> None:
        """Say what happened.

        Args:
            step: what the hands were doing.
            time: since the start of the animation (s).
            cause: what was found, one sentence.
        """
        self.step = step
        self.time = time
        self.cause = cause
        super().__init__(f"at {time:.2f} s, {step}: {cause}")


class DeviceUnavailable(Exception):  # noqa: N818
    """A device was asked for that is not there; the message lists those that are."""

    def __init__(self, name: str, available: Sequence[str]) -> None:
        self.name = name
        self.available = tuple(available)
        super().__init__(f'there is no device "{name}", only {", ".join(available)}')
