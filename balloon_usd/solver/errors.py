"""What can go wrong in a simulation."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence


class SimulationFailed(Exception):  # noqa: N818
    """The physics of a sculpture broke down; the message says when, during what, and why."""

    def __init__(self, step: str, time: float, cause: str, frame: int | None = None) -> None:
        """Say what happened.

        Args:
            step: what the hands were doing.
            time: since the start of the animation (s).
            cause: what was found, where, and what helps.
            frame: the first frame that is wrong, counted from 1; None if that is not known.
        """
        self.step = step
        self.time = time
        self.cause = cause
        self.frame = frame
        place = "" if frame is None else f" (frame {frame})"
        super().__init__(f"at {time:.2f} s{place}, {step}: {cause}")

    def __reduce__(self) -> tuple[type[SimulationFailed], tuple[str, float, str, int | None]]:
        """Travel between processes."""
        return SimulationFailed, (self.step, self.time, self.cause, self.frame)


class DeviceUnavailable(Exception):  # noqa: N818
    """A device was asked for that is not there; the message lists those that are."""

    def __init__(self, name: str, available: Sequence[str]) -> None:
        self.name = name
        self.available = tuple(available)
        super().__init__(f'there is no device "{name}", only {", ".join(available)}')

    def __reduce__(self) -> tuple[type[DeviceUnavailable], tuple[str, tuple[str, ...]]]:
        """Travel between processes."""
        return DeviceUnavailable, (self.name, self.available)
