import pathlib
import re

README = pathlib.Path(__file__).parents[3] / "host_sim" / "python" / "README.md"


def test_the_snippets_of_the_readme_run(monkeypatch):
    monkeypatch.chdir(README.parents[2])
    snippets = re.findall(r"```python\n(.*?)```", README.read_text(), re.DOTALL)
    assert len(snippets) == 5
    exec("\n".join(snippets), {})
