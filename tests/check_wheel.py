"""Check a wheel from the outside: one import name, all packages, and what they need beside code.

Usage: python tests/check_wheel.py WHEEL
"""

from __future__ import annotations

import sys
import tomllib
import zipfile
from pathlib import Path

ROOT = Path(__file__).parent.parent
DATA = (
    "roomgraph/py.typed", "roomgraph/__init__.pyi", "roomgraph/slam/__init__.pyi",
    "roomgraph/app/report/templates/report.html.j2",
)  # fmt: skip


def problems(wheel: Path) -> list[str]:
    """Return what is wrong with a wheel, in words; nothing if all is well."""
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    top = {name.split("/")[0] for name in names}
    other = sorted(n for n in top if n != "roomgraph" and not n.endswith(".dist-info"))
    found = [f"other top-level names: {', '.join(other)}"] if other else []
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    wanted = [
        f"{p.replace('.', '/')}/__init__.py" for p in settings["tool"]["setuptools"]["packages"]
    ]
    missing = sorted({*wanted, *DATA} - names)
    return found + ([f"missing: {', '.join(missing)}"] if missing else [])


def main() -> int:
    """Print what is wrong; return the number of problems as exit status."""
    found = problems(Path(sys.argv[1]))
    sys.stdout.write("\n".join(found or ["the wheel is whole"]) + "\n")
    return len(found)


if __name__ == "__main__":
    sys.exit(main())
