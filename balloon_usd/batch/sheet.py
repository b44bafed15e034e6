"""Contact sheets of stages that a batch has written."""

from __future__ import annotations

import traceback
from pathlib import Path
from typing import TYPE_CHECKING

from balloon_usd.batch.messages import Drawn, NotDrawn, Trouble
from balloon_usd.files.hashes import hashes_of

if TYPE_CHECKING:
    from balloon_usd.batch.messages import Draw
    from balloon_usd.batch.order import Order


def draw(asked: Draw, order: Order) -> Drawn | NotDrawn:
    """Draw a contact sheet, and say what became of it.

    What draws is only imported now: most writers never do.
    """
    from balloon_usd.preview import PreviewError, draw_contact_sheet  # noqa: PLC0415
    from balloon_usd.solver.device import start_warp  # noqa: PLC0415

    sheet = order.sheet(asked.name)
    try:
        start_warp()
        draw_contact_sheet(Path(asked.stage), sheet, device=asked.device)
        return Drawn(asked.job, hashes_of(order.folder, [sheet]))
    except PreviewError as error:
        return NotDrawn(asked.job, Trouble.NOT_WRITTEN, f"{asked.name}: {error}")
    except RuntimeError as error:
        # What Warp says of a device without memory, or that is gone.
        return NotDrawn(asked.job, Trouble.NOT_WRITTEN, f"{asked.name}: {sheet} cannot be drawn: {error}")
    except Exception:  # no sculpture takes another one along
        return NotDrawn(asked.job, Trouble.UNFORESEEN, f"{asked.name}: {traceback.format_exc()}")
