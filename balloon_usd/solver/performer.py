"""The performer: the clock of one sculpture, which says what moves of its plan are on."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from balloon_usd.solver.status import Status, comes_undone

if TYPE_CHECKING:
    from balloon_usd.operations.moves import Move
    from balloon_usd.solver.motions.motion import Motion, Motions
    from balloon_usd.solver.sculpture import ComingFrame, Sculpture


class _Running(NamedTuple):
    """A motion that is on."""

    motion: Motion
    start: float
    """Time at which its move begins, s."""
    seconds: float
    """Time that its move takes, s."""
    over: float
    """Time at which its move ends, s."""

    def advance(self, end: float) -> None:
        whole = self.over <= end or self.seconds == 0.0
        self.motion.advance(1.0 if whole else (end - self.start) / self.seconds)


class Performer:
    """Performs the moves of one plan, each by its motion."""

    def __init__(self, sculpture: Sculpture, motions: Motions) -> None:
        """Begin before the first move; `motions`: of every kind of move in the model."""
        self.sculpture = sculpture
        self._motions = motions
        self._moves = sculpture.plan.choreography.moves
        self._begun = 0
        """Moves that have begun."""
        self._running: list[_Running] = []
        self._text = ""
        self.status = Status("")
        """Status of the sculpture after the coming frame."""

    def act(self, frame: ComingFrame) -> None:
        """Set the hands' goals for a frame."""
        self.sculpture.frame, end = frame, frame.end
        if not self._running and not self._begins(end):
            return
        for running in self._running:
            running.advance(end)
        begun = self._begun
        while self._begins(end):
            self._begin(self._moves[self._begun], end)
            self._begun += 1
        self.sculpture.look_after(end, begun=self._begun > begun)
        self._running = [each for each in self._running if each.over > end or not each.motion.ended]
        self._update_status()

    def _begins(self, end: float) -> bool:
        """Tell whether another move begins before a time (s)."""
        return self._begun < len(self._moves) and self._moves[self._begun].start < end

    def _begin(self, move: Move, end: float) -> None:
        self.sculpture.take_up()
        # A move begins where others have brought the rings.
        self.sculpture.hands.settle()
        motion = self._motions[type(move)](move, self.sculpture)
        running = _Running(motion, move.start, move.seconds, move.end)
        running.advance(end)
        self._running.append(running)
        if move.seconds > 0.0:
            self._text = move.text

    def _update_status(self) -> None:
        """Set the status, a new object only where it differs."""
        loose, undone = self.sculpture.unwinding, self.sculpture.undone
        doing = comes_undone(loose) if loose else self._text
        if (doing, undone) != self.status:
            self.status = Status(doing, undone)
