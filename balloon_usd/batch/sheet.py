"""Contact sheets of stages that a batch has written."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.batch.messages import Drawn
from balloon_usd.files.hashes import hashes_of
from balloon_usd.preview.error import PreviewError

if TYPE_CHECKING:
    from balloon_usd.batch.messages import Draw
    from balloon_usd.batch.order import Order


def draw(asked: Draw, order: Order) -> Drawn:
    """Draw a contact sheet.

    Raises:
        PreviewError: it cannot be drawn or written.
    """
    from balloon_usd.preview import draw_contact_sheet  # noqa: PLC0415
    from balloon_usd.solver.device import start_warp  # noqa: PLC0415

    start_warp()
    sheet = order.sheet(asked.name)
    try:
        draw_contact_sheet(Path(asked.stage), sheet, device=asked.device)
    except RuntimeError as error:
        # What Warp says of a device without memory, or that is gone.
        raise PreviewError(f"{sheet} cannot be drawn: {error}") from error
    return Drawn(asked.job, hashes_of(order.folder, [sheet]))
