"""What pages show of the code is up to date."""

from __future__ import annotations

from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
PAGES = sorted(page for page in DOCS.rglob("*.md") if "<!-- generated: " in page.read_text(encoding="utf-8"))


@pytest.mark.parametrize("page", PAGES, ids=[str(page.relative_to(DOCS)) for page in PAGES])
def test_tables_and_examples_are_those_of_the_code(page: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(DOCS)
    from tables import filled  # noqa: PLC0415

    assert filled(page) == page.read_text(encoding="utf-8"), "run python docs/tables.py"
