"""What the page of an operation shows that its code knows: keys, example, moves, sources."""

from __future__ import annotations

from inspect import signature
from typing import TYPE_CHECKING, Any

from balloon_usd.operations.moves import LetGo, Move
from balloon_usd.operations.table import OPERATIONS
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe, RecipeBuilder
from balloon_usd.recipe.key_texts import key_texts
from balloon_usd.recipe.schema import model_schema
from balloon_usd.recipe.writer import flow_text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from balloon_usd.operations.operation import Operation

QUANTITIES = {
    "mm|cm": "length",
    "deg|rad": "angle",
    "N|mN": "force",
    "%": "percent",
    "start|end": "joint",
    "A-Za-z_": "name",
}
"""What a text is whose pattern has such a part."""


def operation_page(operation: type[Operation]) -> str:
    """Return the generated part of the page of an operation, in Markdown."""
    sources = "\n".join(f"- {source}" for source in operation.sources)
    return f"""## Keys

{table(("key", "values", "default", "meaning"), _key_rows(operation))}

In Python, with lengths in metres: `{_call(operation.word)}`
{_rounds(operation)}
## Example

```yaml
{operation.example}```

## Moves of the hands

{_moves(operation)}

## Sources

{sources}
"""


def _rounds(operation: type[Operation]) -> str:
    """Return whether an operation works on round balloons, in a paragraph; nothing of one that works on whole
    balloons of any kind.
    """
    if operation.whole:
        return ""
    kind = "[round balloon](../recipe.md#round-balloons)"
    if not operation.on_rounds:
        return f"\nIt takes no {kind}.\n"
    hearts = "" if operation.on_hearts else ", but no heart"
    return f"\nWhat it works on may be a {kind}, too{hearts}.\n"


def says(operation: type[Operation]) -> str:
    """Return what an operation does, in a sentence."""
    return (operation.__doc__ or "").splitlines()[0]


def written(operation: type[Operation]) -> str:
    """Return the value of an operation as its example writes it."""
    recipe = Recipe.parse(operation.example)
    step = next(step for step in recipe.steps if step.word == operation.word)
    return flow_text(step.entry(recipe.units))


def modifier_row(key: str) -> tuple[str, ...]:
    """Return what may stand beside which operations, and what it means."""
    beside = [each for each in OPERATIONS if key in each.modifiers()]
    without = [each.word for each in OPERATIONS if each not in beside]
    words = ", ".join(each.word for each in beside)
    if len(without) < 2:
        words = f"all but {without[0]}" if without else "all"
    usual = beside[0].model_fields[key].default
    return f"`{key}`", words, key_texts(beside[0])[key] + ("" if usual is None else f" {usual:g} if absent.")


def table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    """Return a table in Markdown."""
    cells = ((" ".join(cell.split()).replace("|", r"\|") for cell in row) for row in rows)
    return "\n".join(f"| {' | '.join(row)} |" for row in (head, ("---",) * len(head), *cells))


def _key_rows(operation: type[Operation]) -> Iterator[tuple[str, ...]]:
    """Yield the word, the keys of its value, and what may stand beside it."""
    definitions = model_schema()["$defs"]
    own = definitions[operation.__name__]["properties"]
    inner = {} if operation.value_model is None else definitions[operation.value_model.__name__]["properties"]
    keys = {operation.word: own[operation.word]}
    keys |= {f"{operation.word}.{name}": key for name, key in inner.items()}
    keys |= {name: own[name] for name in operation.modifiers()}
    for name, key in keys.items():
        default = _default(key["default"]) if "default" in key else ""
        yield f"`{name}`", _values(key), default, key["description"]


def _default(value: str | float) -> str:
    """Return what a key has where it is not given, in Markdown."""
    return f"`{value}`" if isinstance(value, str) else f"`{value:g}`"


def _values(key: dict[str, Any]) -> str:  # noqa: PLR0911
    """Say what a key takes: words, a range, a quantity, or a list or mapping of these."""
    match key:
        case {"oneOf": choices} | {"anyOf": choices}:
            found = [_values(choice) for choice in choices]
            return " or ".join(dict.fromkeys(filter(None, found)))
        case {"enum": words}:
            return ", ".join(f"`{word}`" for word in words)
        case {"items": item}:
            return f"list of {_values(item)}s"
        case {"patternProperties": entries}:
            return f"{_values(*entries.values())} by name"
        case {"$ref": _}:
            return "keys below"
        case {"type": "string"}:
            return next((what for part, what in QUANTITIES.items() if part in key.get("pattern", "")), "text")
        case {"minimum": low, "maximum": high}:
            return f"{low:g} to {high:g}"
    return ""


def _call(word: str) -> str:
    """Return how an operation is called in Python."""
    taken = signature(getattr(RecipeBuilder, word))
    _self, *arguments = taken.parameters.values()
    shown = taken.replace(parameters=arguments, return_annotation=taken.empty)
    return f"builder.{word}{shown}".replace("'", "")


def _moves(operation: type[Operation]) -> str:
    """Return the kinds of moves of the last step of an operation in its example, or why there are none."""
    planned = plan(Recipe.parse(operation.example))
    index = max(at for at, step in enumerate(planned.recipe.steps) if step.word == operation.word)
    moves = [move for move in planned.choreography.moves if move.step == index]
    if not moves:
        return "None: the hands need not do anything."
    kinds = {type(move): move for move in reversed(moves) if type(move) is not LetGo}
    rows = ((move.text, _does(move), _time(move)) for move in sorted(kinds.values(), key=moves.index))
    return table(("in the example", "what hands do", "time"), rows)


def _time(move: Move) -> str:
    return f"{move.seconds:.2g} s" if move.seconds else "none"


def _does(move: Move) -> str:
    return "Wait while the rubber comes to rest." if type(move) is Move else (type(move).__doc__ or "")
