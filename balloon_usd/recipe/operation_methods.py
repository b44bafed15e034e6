"""Methods of the builder, one for each operation of the table."""

from __future__ import annotations

from collections.abc import Mapping
from inspect import Parameter, Signature, getdoc, signature
from typing import TYPE_CHECKING, Any, TypeVar

from balloon_usd.operations.table import OPERATIONS

if TYPE_CHECKING:
    from collections.abc import Callable

    from balloon_usd.operations.operation import Operation

Builder = TypeVar("Builder")


def with_operations(builder: type[Builder]) -> type[Builder]:
    """Give a class with a method `add` a method for each operation."""
    for operation in OPERATIONS:
        _put(builder, operation.word, signature_of(operation), _method(operation))
    return builder


def signature_of(operation: type[Operation]) -> Signature:
    """Return what the method of an operation takes: what makes up its value, and its modifiers."""
    _units, *value = signature(operation.value_of).parameters.values()
    beside = [Parameter(key, Parameter.KEYWORD_ONLY, default=None) for key in operation.modifiers()]
    last = [each for each in value if each.kind is Parameter.VAR_KEYWORD]
    first = [each for each in value if each.kind is not Parameter.VAR_KEYWORD]
    itself = Parameter("self", Parameter.POSITIONAL_ONLY)
    return Signature([itself, *first, *beside, *last], return_annotation="Self")


def require_arguments(operation: type[Operation], /, *what: object, **keys: object) -> None:
    """Raise a `TypeError` with what the method of an operation takes where it does not take these."""
    takes = signature_of(operation)
    twice = [key for key in keys if any(isinstance(each, Mapping) and key in each for each in what)]
    if twice:
        raise TypeError(f'{operation.word}: "{twice[0]}" is given twice, expected it once')
    try:
        takes.bind(None, *what, **keys)
    except TypeError as wrong:
        plain = [each.replace(annotation=Parameter.empty) for each in takes.parameters.values()]
        shown = Signature([each for each in plain if each.name != "self"])
        raise TypeError(f"{operation.word}: {wrong}, expected {operation.word}{shown}") from None


def _method(operation: type[Operation]) -> Callable[..., Any]:
    def method(self: Any, /, *what: Any, **keys: Any) -> Any:
        return self.add(operation.word, *what, **keys)

    method.__doc__ = getdoc(operation)
    return method


def _put(builder: type[Any], name: str, takes: Signature, method: Callable[..., Any]) -> None:
    method.__name__, method.__qualname__ = name, f"{builder.__name__}.{name}"
    # For help texts and documentation.
    method.__annotations__ = {"return": takes.return_annotation}
    method.__signature__ = takes  # type: ignore[attr-defined]
    setattr(builder, name, method)
