"""The budget of one balloon: its tail, twist by twist, and its gas."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from balloon_usd.balloon.air import ATMOSPHERE, GAS_CONSTANT, ROOM_TEMPERATURE
from balloon_usd.balloon.bubble_shape import bubble_of_length, twist_cost
from balloon_usd.balloon.filled_tube import state_at_stretch
from balloon_usd.balloon.tube_theory import gauge_pressure, maxwell_state
from balloon_usd.plan.open_tube import inflated_tube, softened, tail_range

if TYPE_CHECKING:
    from balloon_usd.plan.strip import Strip


@dataclass(frozen=True)
class TwistEntry:
    """What is open to the hands after the twist that ends a bubble."""

    bubble: str
    step: int
    """Index of the step that makes the twist."""
    length_left: float
    """Inflated length of the open part, m."""
    tail_left: float
    """Flat tail, m; 0 when it is used up."""
    pressure: float
    """Gauge pressure of the open part, Pa."""
    hoop_stretch: float
    """Hoop stretch of the open part."""
    energy: float
    """Elastic energy of its rubber, J/m3."""
    sealed: float
    """That of a long tube whose pressure makes it wider by as much as the bubble is, J/m3."""


@dataclass(frozen=True)
class Budget:
    """Tail and gas of one balloon."""

    balloon: str
    tail: float
    """Flat tail at the start, m."""
    cost_per_twist: float
    """Flat tail that one twist of a long bubble fills whose turns draw no rubber in, m."""
    drawn: float
    """Unstressed rubber that turns draw into all necks, m: they fill as much tail and a little more."""
    twists: tuple[TwistEntry, ...]
    """After every bubble that is twisted off, in order."""
    tail_needed: float
    """Flat tail that all twists fill, m."""
    most_tail: float
    """Longest flat tail with which the bubbles still find gas, m."""
    full_length: float
    """Inflated length of the balloon without tail, m."""
    flat_length: float
    """Unstressed length of the balloon, m."""
    volume: float
    """Gas volume when blown up, m3."""
    pressure: float
    """Gauge pressure when blown up, Pa: the Maxwell pressure."""

    @property
    def tail_left(self) -> float:
        """Flat tail at the end, m."""
        return self.twists[-1].tail_left if self.twists else self.tail

    @property
    def tail_used(self) -> float:
        """Flat tail that the twists fill, m."""
        return self.tail - self.tail_left

    @property
    def runs_out(self) -> TwistEntry | None:
        """The first twist that finds no tail to fill."""
        return next((twist for twist in self.twists if twist.tail_left <= 0.0), None)

    @property
    def inflated_length(self) -> float:
        """Inflated length at the start, m."""
        return self._inflated(self.tail)

    @property
    def shortest_inflation(self) -> float:
        """Inflated length (m) below which the bubbles find no gas."""
        return self._inflated(self.most_tail)

    @property
    def longest_inflation(self) -> float:
        """Inflated length (m) above which the tail is used up before the last twist."""
        return self._inflated(self.tail_needed)

    @property
    def gas_amount(self) -> float:
        """Gas blown in, mol, at room temperature."""
        return amount(self.pressure, self.volume)

    def _inflated(self, tail: float) -> float:
        return self.full_length * (1.0 - min(tail, self.flat_length) / self.flat_length)


def blown_up_pressure(strip: Strip) -> float:
    """Return the gauge pressure of a tube that is blown up, Pa: the Maxwell pressure."""
    return gauge_pressure(strip.size, maxwell_state(softened(strip.rubber)).p_star)


def blown_in(strip: Strip) -> float:
    """Return the gas that is blown into a tube, mol, at room temperature, without the rest of its budget."""
    return amount(blown_up_pressure(strip), inflated_tube(strip.size, strip.rubber, strip.tail).volume)


def budget_of(strip: Strip) -> Budget:
    """Return the budget of a strip: it is twisted off once more, bubble by bubble."""
    rubber = softened(strip.rubber)
    tube = inflated_tube(strip.size, rubber, strip.tail)
    volume, maxwell = tube.volume, maxwell_state(rubber)
    twists: list[TwistEntry] = []
    closed = strip.bubbles[-2] if strip.tip_is_tied else None
    for bubble in strip.bubbles[:-1]:
        shape, tube = tube.pinched(bubble.twisted)
        state = tube.state
        pressure = gauge_pressure(strip.size, state.p_star)
        soft = bubble_of_length(strip.size, rubber, bubble.length)
        sealed = state_at_stretch(rubber, shape.diameter / soft.diameter * maxwell.bulged.a)
        energies = (float(rubber.energy(it.a, it.b)) for it in (state, sealed))
        left = tube.inflated_length, tube.rest_length if bubble is closed else tube.tail
        twists.append(TwistEntry(bubble.name, bubble.step, *left, pressure, state.a, *energies))
    room = tail_range(strip.size, rubber, [bubble.twisted for bubble in strip.bubbles[:-1]])
    return Budget(
        balloon=strip.balloon,
        tail=strip.tail,
        cost_per_twist=twist_cost(strip.size, rubber),
        drawn=sum(bubble.drawn[1] for bubble in strip.bubbles),
        twists=tuple(twists),
        tail_needed=room.least,
        most_tail=room.most,
        full_length=strip.size.length * maxwell.bulged.b,
        flat_length=strip.size.length,
        volume=volume,
        pressure=blown_up_pressure(strip),
    )


def amount(pressure: float, volume: float) -> float:
    """Return the gas in a volume (m3), mol: (atmosphere + gauge pressure) volume / (R T)."""
    return (ATMOSPHERE + pressure) * volume / (GAS_CONSTANT * ROOM_TEMPERATURE)
