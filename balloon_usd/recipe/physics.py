"""The optional `physics:` block: a maker of balloons never needs it."""

from typing import Annotated, Literal

from pydantic import StrictBool

from balloon_usd.language.quantities import Between, Duration
from balloon_usd.operations.modifiers import Entries

from .kosaka import Kosaka
from .models import MODELS, ModelName, ModelTraits

MOST_SUBSTEPS = 2000
"""Substeps in a frame that a recipe can ask for."""


class Physics(Entries):
    """How the simulation treats rubber, air and hands."""

    model: ModelName = "latex"
    """Physical model: latex with its gas, or springs and air particles after Kosaka 2008."""
    rubber: Literal["ogden", "ogden-treloar", "gent", "mooney-rivlin", "neo-hooke"] = "ogden"
    """Law of the rubber."""
    softening: StrictBool = True
    """Whether rubber that was stretched once stays softer (Mullins effect)."""
    gravity: Annotated[float, Between(0.0, 100.0, "m/s2")] | None = None
    """Acceleration downwards, m/s2, of the finished figure; chosen by the pose when absent."""
    friction: Annotated[float, Between(0.0, 3.0)] = 0.8
    """Coulomb coefficient of latex on latex."""
    substeps: Annotated[int, Between(20, MOST_SUBSTEPS, whole=True)] | None = None
    """Time steps in a frame; chosen by the level of detail when absent."""
    burst: Literal["report", "stop"] = "report"
    """What to do when a balloon bursts."""
    hold: Annotated[float, Between(0.0, 60.0, "s")] | None = None
    """Seconds shown after the hands let go; chosen by the plan when absent."""
    leak: Duration | None = None
    """How long the finished sculpture leaks while it is held, such as 6 h or 2 days; not at all when absent;
    s in Python."""
    mass_scaling: Literal["selective", "none"] = "selective"
    """Whether vertices that would need a smaller time step are made heavier."""
    kosaka: Kosaka = Kosaka()
    """Constants of the model kosaka."""

    @property
    def traits(self) -> ModelTraits:
        """What is true of all figures of its model."""
        return MODELS[self.model]
