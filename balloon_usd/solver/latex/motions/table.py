"""Motions of the latex model, by kind of move."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.operations import moves
from balloon_usd.solver.latex.motions.aim import Aim
from balloon_usd.solver.latex.motions.bend import LatexBend
from balloon_usd.solver.latex.motions.bring_inside import BringInside
from balloon_usd.solver.latex.motions.curl import Curl
from balloon_usd.solver.latex.motions.cut import Cut
from balloon_usd.solver.latex.motions.face_knot import FaceKnot
from balloon_usd.solver.latex.motions.fall import Fall
from balloon_usd.solver.latex.motions.halve import Halve
from balloon_usd.solver.latex.motions.hold import Hold
from balloon_usd.solver.latex.motions.inflate import Inflate
from balloon_usd.solver.latex.motions.invert import Invert
from balloon_usd.solver.latex.motions.lead_in import LatexLeadIn
from balloon_usd.solver.latex.motions.let_down import LetDown
from balloon_usd.solver.latex.motions.let_go import LatexLetGo
from balloon_usd.solver.latex.motions.level import Level
from balloon_usd.solver.latex.motions.loosen import Loosen
from balloon_usd.solver.latex.motions.pass_through import PassThrough
from balloon_usd.solver.latex.motions.pinch import Pinch
from balloon_usd.solver.latex.motions.plait import Plait
from balloon_usd.solver.latex.motions.pop import Pop
from balloon_usd.solver.latex.motions.press import LatexPress
from balloon_usd.solver.latex.motions.press_in import PressIn
from balloon_usd.solver.latex.motions.set_down import LatexSetDown
from balloon_usd.solver.latex.motions.set_net import LatexSetNet
from balloon_usd.solver.latex.motions.sink import Sink
from balloon_usd.solver.latex.motions.spin import Spin
from balloon_usd.solver.latex.motions.straighten import Straighten
from balloon_usd.solver.latex.motions.stretch_tip import StretchTip
from balloon_usd.solver.latex.motions.thread import Thread
from balloon_usd.solver.latex.motions.tuck import Tuck
from balloon_usd.solver.latex.motions.turn_fold import TurnFold
from balloon_usd.solver.latex.motions.wind_round import WindRound
from balloon_usd.solver.latex.motions.wrap import Wrap
from balloon_usd.solver.motions.bring import Bring
from balloon_usd.solver.motions.gather import Gather
from balloon_usd.solver.motions.wait import Wait
from balloon_usd.solver.motions.weld import Weld

if TYPE_CHECKING:
    from balloon_usd.solver.motions.motion import Motions

LATEX_MOTIONS: Motions = {
    moves.Move: Wait,
    moves.Inflate: Inflate,
    moves.LetDown: LetDown,
    moves.Sink: Sink,
    moves.Pinch: Pinch,
    moves.Halve: Halve,
    moves.Spin: Spin,
    moves.Gather: Gather,
    moves.Wrap: Wrap,
    moves.LeadIn: LatexLeadIn,
    moves.Bring: Bring,
    moves.SetNet: LatexSetNet,
    moves.Bend: LatexBend,
    moves.Curl: Curl,
    moves.Aim: Aim,
    moves.Tuck: Tuck,
    moves.Press: LatexPress,
    moves.PassThrough: PassThrough,
    moves.BringInside: BringInside,
    moves.Pop: Pop,
    moves.Cut: Cut,
    moves.StretchTip: StretchTip,
    moves.Thread: Thread,
    moves.WindRound: WindRound,
    moves.Plait: Plait,
    moves.Invert: Invert,
    moves.FaceKnot: FaceKnot,
    moves.PressIn: PressIn,
    moves.Weld: Weld,
    moves.TurnFold: TurnFold,
    moves.Straighten: Straighten,
    moves.Level: Level,
    moves.SetDown: LatexSetDown,
    moves.Fall: Fall,
    moves.Loosen: Loosen,
    moves.LetGo: LatexLetGo,
    moves.Hold: Hold,
}
