import pathlib
import re

README = pathlib.Path(__file__).parents[3] / "host_sim" / "python" / "README.md"


def test_the_snippets_of_the_readme_run(monkeypatch, tmp_path):
    (tmp_path / "host_sim").symlink_to(README.parents[1])
    monkeypatch.chdir(tmp_path)
    snippets = re.findall(r"```python\n(.*?)```", README.read_text(), re.DOTALL)
    assert len(snippets) == 9
    exec("\n".join(snippets), {})
