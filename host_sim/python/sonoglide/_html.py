"""Tables as notebooks show them."""

from __future__ import annotations

import html
from collections.abc import Iterable, Mapping
from typing import Any


def shown(value: Any) -> str:
    """A value as a person reads it: numbers with six digits, - where there is none."""
    if value is None:
        return "-"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, list):
        return "[" + ", ".join(map(shown, value)) + "]"
    return str(value)


def table(title: str, header: Iterable[str], rows: Iterable[Iterable[Any]]) -> str:
    """An HTML table."""

    def line(tag: str, cells: Iterable[Any]) -> str:
        inner = "".join(f"<{tag}>{html.escape(shown(each))}</{tag}>" for each in cells)
        return f"<tr>{inner}</tr>"

    lines = line("th", header) + "".join(line("td", row) for row in rows)
    return f"<table><caption>{html.escape(title)}</caption>{lines}</table>"


def fields(title: str, values: Mapping[str, Any]) -> str:
    """A table of names and values."""
    return table(title, ["", ""], values.items())
