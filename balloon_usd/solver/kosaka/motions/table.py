"""Motions of the thesis's model, by kind of move."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.operations import moves
from balloon_usd.solver.kosaka.motions.bend import KosakaBend
from balloon_usd.solver.kosaka.motions.draw import Draw
from balloon_usd.solver.kosaka.motions.weld import KosakaWeld
from balloon_usd.solver.motions.bring import Bring
from balloon_usd.solver.motions.gather import Gather
from balloon_usd.solver.motions.lead_in import LeadIn
from balloon_usd.solver.motions.let_go import LetGo
from balloon_usd.solver.motions.press import Press
from balloon_usd.solver.motions.set_down import SetDown
from balloon_usd.solver.motions.set_net import SetNet
from balloon_usd.solver.motions.wait import Wait

if TYPE_CHECKING:
    from balloon_usd.solver.motions.motion import Motions

KOSAKA_MOTIONS: Motions = {
    moves.Move: Wait,
    # Capsules start blown up, and rings freeze instead of being wound.
    moves.Inflate: Wait,
    moves.Spin: Wait,
    moves.TurnFold: Wait,
    moves.Pinch: Draw,
    moves.Halve: Wait,
    moves.Gather: Gather,
    moves.LeadIn: LeadIn,
    moves.Bring: Bring,
    moves.SetNet: SetNet,
    moves.Bend: KosakaBend,
    moves.Press: Press,
    moves.Weld: KosakaWeld,
    moves.SetDown: SetDown,
    # Only latex has a weight, bursts, softens, and has balloons in others.
    moves.LetDown: Wait,
    moves.BringInside: Wait,
    moves.Sink: Wait,
    moves.Fall: Wait,
    moves.Pop: Wait,
    moves.Cut: Wait,
    moves.StretchTip: Wait,
    moves.Curl: Wait,
    moves.Aim: Wait,
    moves.Tuck: Wait,
    moves.PassThrough: Wait,
    moves.Thread: Wait,
    moves.WindRound: Wait,
    moves.Plait: Wait,
    moves.Wrap: Wait,
    moves.Invert: Wait,
    moves.FaceKnot: Wait,
    moves.PressIn: Wait,
    moves.Loosen: Wait,
    moves.Straighten: Wait,
    moves.Level: Wait,
    moves.LetGo: LetGo,
    moves.Hold: Wait,
}
