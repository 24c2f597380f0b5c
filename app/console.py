"""What the command line says, and how."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from rich.console import Console, RenderableType
from rich.markup import escape
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    SpinnerColumn,
    TextColumn,
    TimeRemainingColumn,
)
from rich.text import Text

Advance = Callable[[int, int, str], None]

LOGGER = "roomgraph"


class Terminal:
    """Notes and progress bars on standard output; nothing at all if quiet."""

    def __init__(self, quiet: bool = False, verbose: bool = False) -> None:
        self.console = Console(quiet=quiet, highlight=False)
        self.verbose = verbose

    def say(self, text: RenderableType, dim: bool = False) -> None:
        """Print a line as it is, however long, or a table."""
        self.console.print(text, style="dim" if dim else None, markup=False, soft_wrap=True)

    def warn(self, text: str) -> None:
        """Print a line that a person should not overlook."""
        self.console.print(Text(f"warning: {text}", style="yellow"), soft_wrap=True)

    @contextmanager
    def working(self, text: str) -> Iterator[None]:
        """Say what is going on while the block runs, where nothing can be counted."""
        with self.console.status(escape(text)):
            yield

    @contextmanager
    def progress(self, title: str) -> Iterator[Advance]:
        """Show a bar while the block runs; call what it gives with done, total and a remark."""
        columns = (
            SpinnerColumn(), TextColumn("[bold]{task.description}"), BarColumn(),
            MofNCompleteColumn(), TimeRemainingColumn(), TextColumn("[dim]{task.fields[remark]}"),
        )  # fmt: skip
        with Progress(*columns, console=self.console) as bar:
            task = bar.add_task(escape(title), total=None, remark="")

            def advance(done: int, total: int, remark: str = "") -> None:
                bar.update(task, completed=done, total=total, remark=escape(remark))

            yield advance

    @contextmanager
    def logging(self, path: Path | None = None) -> Iterator[None]:
        """Write our packages' log to a file, and to standard error if verbose."""
        handlers: list[logging.Handler] = []
        if path is not None:
            handlers.append(logging.FileHandler(path, encoding="utf-8"))
        if self.verbose:
            handlers.append(logging.StreamHandler())
        for handler in handlers:
            handler.setFormatter(
                logging.Formatter("%(asctime)s %(levelname)s %(name)s %(message)s")
            )
        logger = logging.getLogger(LOGGER)
        logger.setLevel(logging.INFO)
        for handler in handlers:
            logger.addHandler(handler)
        try:
            yield
        finally:
            for handler in handlers:
                logger.removeHandler(handler)
                handler.close()
