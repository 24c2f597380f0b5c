"""JSON files that say what they are: a schema name, a version, then the content."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from roomgraph.datasets.files import write_text
from roomgraph.semantics.errors import SemanticsError


def write_document(path: Path, schema: str, version: int, content: Mapping[str, Any]) -> None:
    """Write `content` as JSON under its schema name and version, through a temporary file."""
    document = {"schema": schema, "version": version, **content}
    write_text(path, json.dumps(document, indent=1, allow_nan=False) + "\n")


def read_document(path: Path, schema: str, *versions: int) -> dict[str, Any]:
    """Read a JSON file of the given schema, of any of the versions, the newest first.

    Raises
    ------
    SemanticsError
        The file is missing, is not JSON, or is something else.
    """
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise SemanticsError("file cannot be read", where=path, got=str(error)) from error
    except json.JSONDecodeError as error:
        raise SemanticsError(
            "file is not JSON", where=f"{path}:{error.lineno}", expected=schema, got=error.msg
        ) from error
    found = (document.get("schema"), document.get("version")) if isinstance(document, dict) else ()
    if found not in [(schema, version) for version in versions]:
        raise SemanticsError(
            "wrong kind of file", where=path, expected=f"{schema} version {versions[0]}",
            got=" version ".join(str(part) for part in found) or type(document).__name__,
        )  # fmt: skip
    return dict(document)
