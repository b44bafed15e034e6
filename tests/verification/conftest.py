"""The verification table: what was measured against theory, printed at the end of a run."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

README = Path(__file__).parents[2] / "README.md"
BEGIN, END = "<!-- verification table -->", "<!-- end of verification table -->"
TABLE = pytest.StashKey[list["Row"]]()


@dataclass(frozen=True)
class Row:
    """One line of the table."""

    case: str
    quantity: str
    theory: float
    measured: float
    tolerance: float

    @property
    def error(self) -> float:
        """Relative where the theory is not 0."""
        return abs(self.measured - self.theory) / (abs(self.theory) or 1.0)

    def __str__(self) -> str:
        numbers = f"{self.theory:12.6g} {self.measured:12.6g} {self.error:10.2e} {self.tolerance:10.1e}"
        return f"{self.case:5} {self.quantity:52} {numbers}"


def pytest_addoption(parser):
    parser.addoption("--update-table", action="store_true", help="write the README's verification table anew")


@pytest.fixture
def verify(request):
    """Hold a measured value against theory at a relative tolerance (absolute where theory says 0)."""

    def check(case, quantity, measured, theory, tolerance):
        row = Row(case, quantity, float(theory), float(measured), tolerance)
        request.config.stash.setdefault(TABLE, []).append(row)
        assert row.error <= tolerance, (
            f"{case} {quantity}: error {row.error:.2e}, {measured} against {theory}"
        )

    return check


def pytest_terminal_summary(terminalreporter, config):
    rows = config.stash.get(TABLE, [])
    if rows:
        terminalreporter.section("verification")
        terminalreporter.line(
            f"{'case':5} {'quantity':52} {'theory':>12} {'measured':>12} {'error':>10} {'tol.':>10}"
        )
        for row in rows:
            terminalreporter.line(str(row))
    if rows and config.getoption("--update-table", default=False):
        write_table(rows)


def write_table(rows):
    """Put the line of every case that is nearest to its tolerance into the README."""
    worst = {}
    for row in rows:
        if (
            row.case not in worst
            or row.error / row.tolerance > worst[row.case].error / worst[row.case].tolerance
        ):
            worst[row.case] = row
    lines = [
        "| case | nearest to its limit | theory | solver | error | allowed |",
        "|---|---|---|---|---|---|",
    ]
    for case in sorted(worst):
        row = worst[case]
        numbers = f"{row.theory:.6g} | {row.measured:.6g} | {row.error:.1e} | {row.tolerance:.0e}"
        count = sum(other.case == case for other in rows)
        lines.append(f"| {case} ({count}) | {row.quantity} | {numbers} |")
    text = README.read_text(encoding="utf-8")
    before, after = text.split(BEGIN)[0], text.split(END)[1]
    README.write_text(before + BEGIN + "\n\n" + "\n".join(lines) + "\n\n" + END + after, encoding="utf-8")
