"""Tolerances on the command line: `--tol points=1e-4`, `--abs`, `--rel`, `--rms`."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from collections.abc import Callable

    from balloon_usd.diff import Tolerances


def amount(text: str) -> float:
    """Read a tolerance that is one number.

    Raises:
        click.BadParameter: it is none, or negative.
    """
    try:
        # Python would take 1_0, and digits of other scripts.
        value = float(text) if re.fullmatch(r"[-+.\w]+", text, re.ASCII) and "_" not in text else math.nan
    except ValueError:
        value = math.nan
    if not 0.0 <= value < math.inf:
        raise click.BadParameter(f'"{text}" is no tolerance, expected a number such as 1e-4')
    return value


def tolerance_options(command: Callable[..., None]) -> Callable[..., None]:
    """Add the options to a command."""
    options = (
        click.option(
            "--tol",
            "named",
            multiple=True,
            metavar="NAME=AMOUNT",
            help='What floats of an attribute may differ by: "points=1e-4" in its unit, "stretch=2%" of its '
            'size, "pressure=5+2%" both. May be repeated.',
        ),
        click.option(
            "--abs",
            "absolute",
            type=amount,
            metavar="NUMBER",
            help="The same for all other attributes, in their units.",
        ),
        click.option(
            "--rel",
            "relative",
            type=amount,
            metavar="NUMBER",
            help="The same for all others, as a share: 0.01 is 1 %.",
        ),
        click.option(
            "--rms",
            type=amount,
            metavar="METRES",
            help="Distance in metres that the points of a surface may have in one frame, as the root of the "
            "mean square.",
        ),
    )
    for option in reversed(options):
        command = option(command)
    return command


def tolerances_of(
    named: tuple[str, ...], absolute: float | None, relative: float | None, rms: float | None
) -> Tolerances:
    """Read the options.

    Raises:
        click.BadParameter: `--tol` is not NAME=AMOUNT.
    """
    from balloon_usd.diff import Allowed, Tolerances  # noqa: PLC0415

    found: dict[str, Any] = {}
    for text in named:
        name, equals, given = text.partition("=")
        if not (name and equals):
            raise click.BadParameter(f'"{text}" is no tolerance, expected NAME=AMOUNT', param_hint="--tol")
        try:
            found[name.strip()] = Allowed.parse(given)
        except ValueError as error:
            raise click.BadParameter(f"{name}: {error}", param_hint="--tol") from error
    return Tolerances(Allowed(absolute or 0.0, relative or 0.0), found, rms)
