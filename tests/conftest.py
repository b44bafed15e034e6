"""The verification tables: what was measured against theory, and two models side by side, printed at the end of a run."""

from __future__ import annotations

from dataclasses import astuple, dataclass
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[1] / "docs/theory/verification.md"
BEGIN, END = "<!-- verification table -->", "<!-- end of verification table -->"
MODELS_BEGIN, MODELS_END = "<!-- table of both models -->", "<!-- end of table of both models -->"
MODELS_HEAD = ("what", "theory", "`latex`", "`kosaka`")
MEASURED = pytest.StashKey[dict[str, list[list]]]()
"""What the tests measured, by its kind: a row of theory, a note, a line of both models."""


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
    parser.addoption(
        "--update-table", action="store_true", help="write the tables of docs/theory/verification.md anew"
    )


@pytest.fixture
def verify(request):
    """Hold a measured value against theory at a relative tolerance (absolute where theory says 0)."""

    def check(case, quantity, measured, theory, tolerance, told=""):
        row = Row(case, quantity, float(theory), float(measured), tolerance)
        measured_by(request, "row", astuple(row))
        assert row.error <= tolerance, (
            f"{case} {quantity}: error {row.error:.2e}, {measured} against {theory}\n{told}"
        )

    return check


@pytest.fixture
def note(request):
    """Tell at the end of a run what was measured where theory has no number."""

    def tell(case, text):
        measured_by(request, "note", (f"{case:5} {text}",))

    return tell


@pytest.fixture
def side_by_side(request):
    """Write one line of the table of both models: what theory says, and what each model does."""

    def line(what, theory, latex, kosaka):
        measured_by(request, "models", (what, theory, latex, kosaka))

    return line


def measured_by(request, kind, cells):
    """Send cells with the test's report, which is all that reaches the process that prints from a worker."""
    request.node.user_properties.append((kind, cells))


class Gathering:
    """Gathers what the tests of all workers measured."""

    def __init__(self, config):
        self.measured = config.stash.setdefault(MEASURED, {"row": [], "note": [], "models": []})

    def pytest_runtest_logreport(self, report):
        if report.when == "call":
            for kind, cells in report.user_properties:
                self.measured[kind].append(cells)


def pytest_configure(config):
    config.pluginmanager.register(Gathering(config))


def pytest_terminal_summary(terminalreporter, config):
    measured = config.stash[MEASURED]
    rows = [Row(*cells) for cells in measured["row"]]
    notes, models = [text for (text,) in measured["note"]], measured["models"]
    if rows or notes:
        terminalreporter.section("verification")
    if rows:
        terminalreporter.line(
            f"{'case':5} {'quantity':52} {'theory':>12} {'measured':>12} {'error':>10} {'tol.':>10}"
        )
    for line in (*rows, *notes):
        terminalreporter.line(str(line))
    if models:
        terminalreporter.section("both models")
    for cells in models:
        terminalreporter.line("  ".join(f"{cell:28}" for cell in cells))
    if config.getoption("--update-table", default=False):
        if rows:
            write_between(BEGIN, END, verification_lines(rows))
        if models:
            rule = "|---" * len(MODELS_HEAD) + "|"
            head, *lines = (f"| {' | '.join(cells)} |" for cells in (MODELS_HEAD, *models))
            write_between(MODELS_BEGIN, MODELS_END, [head, rule, *lines])


def verification_lines(rows):
    """Lines of a table with the row of every case that is nearest to its tolerance; cases that did not run keep the
    line that they have.
    """
    written = PAGE.read_text(encoding="utf-8").split(BEGIN)[1].split(END)[0].strip().splitlines()[2:]
    lines = {line.split()[1]: line for line in written}
    for case in {row.case for row in rows}:
        all_of_it = [row for row in rows if row.case == case]
        worst = max(all_of_it, key=lambda row: row.error / row.tolerance)
        numbers = f"{worst.theory:.6g} | {worst.measured:.6g} | {worst.error:.1e} | {worst.tolerance:.1e}"
        lines[case] = f"| {case} ({len(all_of_it)}) | {worst.quantity} | {numbers} |"
    head = [
        "| case | nearest to its limit | theory | solver | error | allowed |",
        "|---|---|---|---|---|---|",
    ]
    return [*head, *(lines[case] for case in sorted(lines))]


def write_between(begin, end, lines):
    """Put lines between two marks of the page."""
    text = PAGE.read_text(encoding="utf-8")
    before, after = text.split(begin)[0], text.split(end)[1]
    PAGE.write_text(before + begin + "\n\n" + "\n".join(lines) + "\n\n" + end + after, encoding="utf-8")
