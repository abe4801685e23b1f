"""The notebooks run from top to bottom, and the numbers they show are those of today."""

import ast
import json
from pathlib import Path

import pytest

NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("*.ipynb"))


def test_there_are_notebooks() -> None:
    assert len(NOTEBOOKS) == 2


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(notebook: Path) -> None:
    pytest.importorskip("matplotlib").use("Agg")
    names: dict[str, object] = {}
    for cell in json.loads(notebook.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] != "code":
            continue
        source = "".join(cell["source"])
        *before, last = ast.parse(source).body
        exec(compile(ast.Module(before, []), notebook.name, "exec"), names)
        if not isinstance(last, ast.Expr):
            exec(compile(ast.Module([last], []), notebook.name, "exec"), names)
            continue
        value = eval(compile(ast.Expression(last.value), notebook.name, "eval"), names)
        shown = ["".join(o["data"]["text/plain"]) for o in cell["outputs"] if "text/plain" in o.get("data", {})]
        if shown and "0x" not in repr(value) and "Figure" not in shown[-1] and " s, finest" not in shown[-1]:
            assert shown[-1].strip() == repr(value).strip() or "e-" in shown[-1], source
