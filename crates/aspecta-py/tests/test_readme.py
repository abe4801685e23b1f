"""The lines of Python that the readmes show do what they say."""

import re
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1]


@pytest.mark.parametrize("readme", [PACKAGE / "README.md", PACKAGE.parents[1] / "README.md"])
def test_the_lines_of_a_readme_run(readme: Path) -> None:
    pytest.importorskip("matplotlib").use("Agg")
    blocks = re.findall(r"```python\n(.*?)```", readme.read_text(encoding="utf-8"), re.S)
    assert blocks
    names: dict[str, object] = {}
    for block in blocks:
        for line in filter(None, block.splitlines()):
            said = re.search(r"# (True|\(10, 10\)|10 )", line)
            code = line.split("  #")[0]
            try:
                value = eval(code, names)
            except SyntaxError:
                exec(code, names)
                continue
            if said:
                assert repr(value) == said[1].strip(), line
