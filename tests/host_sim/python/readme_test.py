import pathlib
import re

import pytest

README = pathlib.Path(__file__).parents[3] / "host_sim" / "python" / "README.md"


def test_the_snippets_of_the_readme_run(monkeypatch, tmp_path):
    (tmp_path / "host_sim").symlink_to(README.parents[1])
    monkeypatch.chdir(tmp_path)
    snippets = re.findall(r"```python\n(.*?)```", README.read_text(), re.DOTALL)
    assert len(snippets) == 10
    exec("\n".join(snippets), {})


def test_the_plot_of_the_explanation_is_drawn(monkeypatch, tmp_path):
    pytest.importorskip("matplotlib").use("Agg")
    monkeypatch.chdir(tmp_path)
    text = (README.parents[1] / "scenes/why_vibration_lowers_friction.md").read_text()
    [snippet] = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    exec(snippet, {})
    assert (tmp_path / "curves.svg").stat().st_size > 10_000
