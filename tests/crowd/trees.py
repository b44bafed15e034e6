"""Recipes that nobody chose: random trees of bubbles, locked pairs and chains, and loops."""

from __future__ import annotations

from dataclasses import dataclass, field
from random import Random

SIDES = ("up", "down", "left", "right")
LONGEST = 90.0
"""Most that the bubbles of one balloon are long together, cm."""
REST = 12.0
"""What is left of each balloon, cm."""


@dataclass
class Tree:
    """A recipe that grows step by step."""

    random: Random
    steps: list[str] = field(default_factory=list)
    joints: list[str] = field(default_factory=list)
    """Ends of bubbles at which another balloon can be tied."""
    bubbles: int = 0

    def name(self) -> str:
        """Return a name that no bubble has."""
        self.bubbles += 1
        return f"b{self.bubbles}"

    def length(self, least: float, most: float) -> float:
        """Return a length in half centimetres."""
        return self.random.randint(round(2 * least), round(2 * most)) / 2

    def twist(self, balloon: str, names: list[str], length: float) -> None:
        """Twist off bubbles of one length."""
        sizes = ", ".join(f"{name}: {length}" for name in names)
        self.steps.append(f"  - bubbles: {{{sizes}}}\n    balloon: {balloon}")
        self.joints += [f"{name}.end" for name in names]

    def grow(self, balloon: str) -> float:
        """Make one part of a figure of what is left of a balloon; return how long it is, cm."""
        kind = self.random.choices(("bubble", "pair", "chain", "loop"), (6, 8, 2, 3))[0]
        point = self.random.choice(SIDES)
        if kind == "loop":
            name, length = self.name(), self.length(15, 24)
            self.steps.append(f"  - loop: {{{name}: {length}}}\n    balloon: {balloon}\n    point: {point}")
            self.joints.append(f"{name}.end")
            return length
        names = [self.name() for _ in range({"bubble": 1, "pair": 2, "chain": 3}[kind])]
        length = self.length(3, 12 if kind == "bubble" else 9)
        self.twist(balloon, names, length)
        if len(names) > 1:
            self.steps.append(f"  - lock: [{', '.join(names)}]\n    point: {point}")
        return length * len(names)

    def balloon(self, balloon: str) -> float:
        """Make all of a balloon; return how far it is blown up, cm."""
        length = 0.0
        if self.joints:
            where, first, length = self.random.choice(self.joints), self.name(), self.length(3, 10)
            self.twist(balloon, [first], length)
            self.steps.append(f"  - lock: {{joints: [{where}, {first}.start]}}")
        most = self.random.uniform(0.4, 1.0) * LONGEST
        while length < most - 27.0:
            length += self.grow(balloon)
        self.steps.append(f"  - rest: rest_of_{balloon}\n    balloon: {balloon}")
        return length + REST


def tree(seed: int) -> str:
    """Return a recipe of one to three balloons, the same for the same seed."""
    growing = Tree(Random(seed))
    names = ["red", "yellow", "blue"][: growing.random.choices((1, 2, 3), (6, 3, 1))[0]]
    blown = {name: growing.balloon(name) for name in names}
    balloons = "\n".join(
        f"  {name}: {{size: 260, color: {name}, inflated: {length}}}" for name, length in blown.items()
    )
    steps = "\n".join(growing.steps)
    return f"format: 1\nname: tree_{seed}\nunits: cm\nballoons:\n{balloons}\nsteps:\n{steps}\n"
