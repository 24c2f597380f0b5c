"""Terminal output: notes, warnings, progress bars and logging."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter

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
# Lines in place of a bar are a tenth of the work and this many seconds apart at least.
LINES_PER_WORK, BETWEEN_LINES_S = 10, 15.0


class Terminal:
    """Notes and progress bars on standard output; nothing at all if quiet."""

    def __init__(self, quiet: bool = False, verbose: bool = False) -> None:
        self.console = Console(quiet=quiet, highlight=False)
        self._errors = Console(quiet=quiet, highlight=False, stderr=True)
        self.verbose = verbose

    def say(self, text: RenderableType, dim: bool = False) -> None:
        """Print a line as it is, however long, or a table."""
        self.console.print(text, style="dim" if dim else None, markup=False, soft_wrap=True)

    def warn(self, text: str) -> None:
        """Print a warning."""
        self.console.print(Text(f"warning: {text}", style="yellow"), soft_wrap=True)

    def _note(self, text: str) -> None:
        """Print a line on standard error."""
        self._errors.print(text, markup=False, soft_wrap=True)

    @contextmanager
    def working(self, text: str) -> Iterator[None]:
        """Show a message while the block runs, for work that cannot be counted."""
        if not self.console.is_terminal:
            self._note(text)
        with self.console.status(escape(text)):
            yield

    @contextmanager
    def progress(self, title: str, unit: str = "") -> Iterator[Advance]:
        """Show a bar while the block runs; call the result with done, total and a remark.

        Where the output is no terminal, a line is printed now and then, which counts in `unit`, on
        standard error: what a command is asked for stays alone on standard output.
        """
        if not self.console.is_terminal:
            lines = _ProgressLines(title, unit, self._note)
            yield lines.advance
            lines.end()
            return
        columns = (
            SpinnerColumn(), TextColumn("[bold]{task.description}"), BarColumn(),
            MofNCompleteColumn(), TimeRemainingColumn(), TextColumn("[dim]{task.fields[remark]}"),
        )  # fmt: skip
        with Progress(*columns, console=self.console) as bar:
            task = bar.add_task(escape(title), total=None, remark="")

            def advance(done: int, total: int, remark: str = "") -> None:
                bar.update(task, completed=done, total=total, remark=escape(remark or unit))

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


class _ProgressLines:
    """Reports progress in lines, for output that is not a terminal."""

    def __init__(self, title: str, unit: str, say: Callable[[str], None]) -> None:
        self._title, self._unit, self._say = title, unit, say
        self._begun_s = self._said_s = perf_counter()
        self._done = self._total = self._said = 0
        say(f"{title} ...")

    def advance(self, done: int, total: int, remark: str = "") -> None:
        """Update the count; print it if due. The last count is printed by `end`."""
        self._done, self._total = done, total
        is_tenth = (done - self._said) * LINES_PER_WORK >= total
        if is_tenth and done < total and perf_counter() - self._said_s >= BETWEEN_LINES_S:
            self._said, self._said_s = done, perf_counter()
            self._print(remark)

    def end(self) -> None:
        """Print how much was done, and the time it took."""
        self._print("" if self._total else "done")

    def _print(self, remark: str) -> None:
        count = f"{self._done} of {self._total} {self._unit}".rstrip() if self._total else ""
        parts = [part for part in (count, remark) if part]
        took = f"{perf_counter() - self._begun_s:.0f} s"
        self._say(f"{self._title}: {', '.join([*parts, took])}")
