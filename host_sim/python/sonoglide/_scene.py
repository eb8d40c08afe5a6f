"""Scenes, and the examples that come with the package."""

from __future__ import annotations

import json
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from . import _core, _html

#: The folder of the example scenes, `target_step.toml` among them.
scenes = Path(__file__).parent / "scenes"
#: The folder of the notebooks. Copy it to one of your own to work with them.
notebooks = Path(__file__).parent / "notebooks"


def _toml(value: Any) -> str:
    """Numbers have every bit."""
    if hasattr(value, "tolist"):  # numpy's
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_toml(_key(k))} = {_toml(v)}" for k, v in value.items()) + " }"
    return "[" + ", ".join(map(_toml, value)) + "]"


def _key(key: Any) -> str:
    if not isinstance(key, str):
        raise TypeError(f'a key is {key!r}; allowed: a text, "table.key" of a scene')
    return key


def _options(overrides: Mapping[str, Any]) -> list[str]:
    """As options of `sonoglide run --set`; None removes a key."""
    return [f"{_key(k)}={'' if v is None else _toml(v)}" for k, v in overrides.items()]


def _made(*arguments: Any) -> Scene:
    scene = Scene.__new__(Scene)
    _core.Scene.__init__(scene, *arguments)
    return scene


class Scene(_core.Scene):
    """A scene: plant, friction, drive, solver and controller of one run. It does not change.

    path       a scene file (TOML)
    overrides  {"table.key": value}, in the units of the keys; None removes a key

    Raises SceneError, with line and column, and OSError of a file that cannot be read. Scenes are
    equal if all their values are, with the defaults filled in; the name does not count.
    """

    def __init__(self, path: str | PathLike[str], overrides: Mapping[str, Any] = {}) -> None:
        file = Path(path)  # open() alone would take a number for a file that is open, and close it
        with open(file, "rb"):
            pass
        super().__init__(file, _options(overrides))

    @staticmethod
    def from_text(text: str, overrides: Mapping[str, Any] = {}, name: str = "scene") -> Scene:
        """The same from TOML text; name stands for the file in errors."""
        return _made(name, text, _options(overrides))

    @staticmethod
    def from_dict(
        tables: Mapping[str, Mapping[str, Any]], overrides: Mapping[str, Any] = {}, name: str = "scene"
    ) -> Scene:
        """The same from {table: {key: value}}, as `values` has them."""
        lines = []
        for table, keys in tables.items():
            lines.append(f"[{_key(table)}]")
            lines += [f"{_toml(_key(key))} = {_toml(value)}" for key, value in keys.items()]
        return Scene.from_text("\n".join(lines), overrides, name)

    def replace(self, overrides: Mapping[str, Any]) -> Scene:
        """The scene with more overrides: they win."""
        return _made(self, _options(overrides))

    @property
    def values(self) -> dict[str, dict[str, Any]]:
        """{table: {key: value}} with every default filled in; SI units, as the keys say."""
        values: dict[str, dict[str, Any]] = json.loads(self.json)
        return values

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _core.Scene):
            return NotImplemented
        return self.json == other.json

    def __hash__(self) -> int:
        return hash(self.json)

    def __reduce__(self) -> tuple[Any, ...]:
        return _made, self.origin()

    def __copy__(self) -> Scene:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Scene:
        return self

    def __repr__(self) -> str:
        values = self.values
        control = values.get("controller")
        kind = f"closed loop in {control['arithmetic']}" if control else "open loop"
        return f"<sonoglide.Scene {self.name}: {values['friction']['law']}, {kind}>"

    def _repr_html_(self) -> str:
        rows = [(table, key, value) for table, keys in self.values.items() for key, value in keys.items()]
        return _html.table(f"Scene {self.name}", ["table", "key", "value"], rows)
