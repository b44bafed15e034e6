"""Every deliberate damage of a good stage on disk is found, under the property that it breaks."""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING

import pytest
from pxr import Usd

from balloon_usd.check import check_file
from tests.check.layered_damages import LAYERED_DAMAGES
from tests.stage.damages import AIR_DAMAGES, DAMAGES

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

NOT_OPENING = {"missing reference", "missing sublayer", "absolute sublayer"}
"""Damages after which the stage cannot be read: they have tests of their own."""
FLAT = [damage for damage in DAMAGES if damage[1] not in NOT_OPENING]


def named(damages: list[tuple[int, str, Callable]]) -> list[str]:
    return [f"{number}-{what}" for number, what, _ in damages]


def rules_after(damage: Callable[[Usd.Stage], object], file: Path) -> set[str]:
    """Rules that a stage breaks once it is damaged."""
    stage = Usd.Stage.Open(str(file))
    damage(stage)
    stage.GetRootLayer().Save()
    del stage
    return rules(file)


def rules(path: Path) -> set[str]:
    """Rules that a stage breaks."""
    report = check_file(str(path))
    assert not report.unreadable
    return {fault.rule for fault in report.faults}


@pytest.mark.parametrize(
    "name",
    [
        "dog",
        "dog/dog.usda",
        "dog.usdc",
        "dog.usdz",
        "dog_shot.usda",
        "capsule",
        "capsule.usdc",
        "capsule_shot.usda",
    ],
)
def test_a_stage_as_it_is_written_has_no_fault(name: str, stages: Path) -> None:
    report = check_file(str(stages / name))
    assert (report.unreadable, report.found) == ("", [])
    assert report.selections


@pytest.mark.parametrize(("number", "what", "damage"), FLAT, ids=named(FLAT))
def test_a_damage_of_a_flat_stage_is_found(
    number: int, what: str, damage: Callable[[Usd.Stage], object], stages: Path, tmp_path: Path
) -> None:
    file = shutil.copy(stages / "dog.usdc", tmp_path)
    assert str(number) in rules_after(damage, file)


@pytest.mark.parametrize(("number", "what", "damage"), AIR_DAMAGES, ids=named(AIR_DAMAGES))
def test_a_damage_of_the_air_is_found(
    number: int, what: str, damage: Callable[[Usd.Stage], object], stages: Path, tmp_path: Path
) -> None:
    shutil.copy(stages / "wire.png", tmp_path)
    file = shutil.copy(stages / "capsule.usdc", tmp_path)
    assert str(number) in rules_after(damage, file)


@pytest.mark.parametrize(("number", "what", "damage"), LAYERED_DAMAGES, ids=named(LAYERED_DAMAGES))
def test_a_damage_of_an_asset_in_layers_is_found(
    number: int, what: str, damage: Callable[[Path], object], dog: Path
) -> None:
    damage(dog)
    assert str(number) in rules(dog)


def test_there_are_damages_enough_for_every_property_that_a_stage_shows() -> None:
    damages = [*FLAT, *AIR_DAMAGES, *LAYERED_DAMAGES]
    assert len(damages) >= 40
    assert {number for number, _, _ in damages} == {*range(1, 26), 30, 31, 32}
