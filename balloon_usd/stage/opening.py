"""Opening stages, whoever wrote them: quietly, part by part, in a session of one's own."""

from __future__ import annotations

import os
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from balloon_usd.openusd import Sdf, Usd, UsdUtils, usd_access

if TYPE_CHECKING:
    from collections.abc import Iterator

READ_IN_PARTS = "USDC_USE_PREAD"
"""Setting of OpenUSD: binary files are read part by part instead of mapped into memory as a whole."""


@contextmanager
def quiet() -> Iterator[None]:
    """Keep USD's own warnings from the error stream: what they are about is found out otherwise.

    Other threads wait, as what is set here holds for the process.
    """
    with usd_access():
        held = UsdUtils.CoalescingDiagnosticDelegate()
        try:
            yield
        finally:
            held.TakeUncoalescedDiagnostics()
            # The traceback of an exception would keep it, and the silence with it.
            del held


@contextmanager
def streaming() -> Iterator[None]:
    """Open and read stages inside the block quietly, and without their files growing into memory."""
    with quiet():
        before = os.environ.get(READ_IN_PARTS)
        os.environ[READ_IN_PARTS] = "1"
        try:
            yield
        finally:
            if before is None:
                del os.environ[READ_IN_PARTS]
            else:
                os.environ[READ_IN_PARTS] = before


def in_own_session(stage: Any) -> Any:
    """Open a stage once more, to be edited in a session of its own; the one given is left as it is."""
    session = Sdf.Layer.CreateAnonymous()
    other = Usd.Stage.Open(stage.GetRootLayer(), session)
    other.SetEditTarget(session)
    return other


def said_by(error: Any) -> str:
    """What USD says about an error, on one line; "" for what is no text, as in a damaged file."""
    try:
        return " ".join(str(error.args[0].commentary).split())
    except UnicodeDecodeError:
        return ""
