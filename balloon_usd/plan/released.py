"""What nothing holds any more once a bubble is popped that held it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.operations.caution import Caution
from balloon_usd.operations.workpiece import Contact, Popped

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.operations.workpiece import Workpiece


def released(piece: Workpiece) -> Iterator[Caution]:
    """Warn of bubbles that were pushed, rolled or threaded into a ring, or wrapped, and are let go of by a
    pop.
    """
    contacts: list[Contact] = []
    for event in piece.history:
        if isinstance(event, Contact):
            contacts.append(event)
        elif isinstance(event, Popped):
            for contact in contacts:
                if event.bubble in contact.others:
                    others = [other for other in contact.others if other != event.bubble]
                    yield Caution(
                        event.step,
                        f"{contact.bubble} is held no more once {event.bubble} is popped",
                        f"step {contact.step + 1} {contact.text}",
                        f"pop another bubble than {' and '.join([event.bubble, *others])}",
                    )
