"""What nothing holds any more: a bubble that held it is popped, its ring is divided, or a twist slips."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.language.choices import all_of
from balloon_usd.language.joint import ends_of
from balloon_usd.operations.caution import Caution
from balloon_usd.operations.workpiece import Contact, Joined, Popped
from balloon_usd.plan.holding import friction_margin

if TYPE_CHECKING:
    from collections.abc import Iterator

    from balloon_usd.operations.workpiece import Workpiece
    from balloon_usd.recipe import Recipe


def divided(piece: Workpiece) -> Iterator[Caution]:
    """Warn of bubbles whose ring a later step divides by joining joints of it."""
    joined = sorted({event.step for event in piece.history if isinstance(event, Joined)})
    # What is divided stays so: of a ring that is whole in the end no step has to be looked at.
    parted = (each for each in piece.contacts if each.ring and not piece.is_closed(each.others))
    for contact in parted:
        later = (step for step in joined if step > contact.step)
        step = next((step for step in later if not piece.after(step).is_closed(contact.others)), None)
        if step is not None:
            yield Caution(
                step,
                f"{contact.bubble} is held no more once {all_of(contact.others)} are no ring",
                f"step {contact.step + 1} {contact.text}",
                "twist other joints together",
            )


def leaking(recipe: Recipe) -> Iterator[Caution]:
    """Warn of bubbles whose gas only a twist keeps that slips, since what was behind it is popped."""
    piece = recipe.piece
    for event in (event for event in piece.history if isinstance(event, Popped)):
        for end in ends_of(event.bubble):
            joint = piece.joint(end)
            margin = friction_margin(recipe, joint)
            others = sorted({each.bubble for each in joint} - piece.popped)
            if others and margin is not None and margin < 1.0:
                yield Caution(
                    event.step,
                    f"{all_of(others)} may lose gas beside {event.bubble}, which is popped",
                    "the twist that keeps it shut slips when the hands let go",
                    "turns: 3 in the step that twists it",
                )


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
