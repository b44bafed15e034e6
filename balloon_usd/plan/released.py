"""What nothing holds any more once a bubble is popped that held it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.language.choices import all_of
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.workpiece import Contact, Popped

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.operations.workpiece import Workpiece


def released(piece: Workpiece) -> Iterator[Caution]:
    """Warn of bubbles that others hold, in their ring or between them, and that a pop or a cut frees."""
    contacts: list[Contact] = []
    freed: list[Contact] = []
    for event in piece.history:
        if isinstance(event, Contact):
            contacts.append(event)
        elif isinstance(event, Popped):
            for contact in contacts:
                if event.bubble in contact.others and contact not in freed:
                    freed.append(contact)
                    others = [other for other in contact.others if other != event.bubble]
                    yield Caution(
                        event.step,
                        f"{contact.bubble} is held no more once {event.bubble} is popped",
                        f"step {contact.step + 1} {contact.text}",
                        f"keep {all_of([event.bubble, *others])}, pop or cut off another bubble",
                    )
