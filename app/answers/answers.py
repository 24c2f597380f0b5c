"""Output of where images were taken: as text, as JSON, as speech."""

from __future__ import annotations

import json
from collections.abc import Iterable

import typer

from roomgraph.app.answers.locating import Whereabouts
from roomgraph.app.answers.queries import Query
from roomgraph.app.answers.sentences import whereabouts_json, whereabouts_text
from roomgraph.app.answers.speech import Announcer, Voice, spoken
from roomgraph.app.errors import AppError
from roomgraph.semantics.graph.graph import SemanticGraph
from roomgraph.semantics.labels import UNKNOWN

Answers = Iterable[tuple[Query, Whereabouts]]


def answer(
    graph: SemanticGraph, answers: Answers, is_walk: bool, speak: bool, as_json: bool
) -> None:
    """Print the answers as they arrive: for a walk the changes, for images each one.

    If speech is not available or fails, this is reported once; the text output continues.
    """
    voice = _Aloud() if speak else None
    if as_json:
        rows = [whereabouts_json(graph, query.name, where) for query, where in answers]
        typer.echo(json.dumps(rows, indent=1))
    elif is_walk:
        _follow(answers, voice)
    else:
        for query, where in answers:
            typer.echo(f"{query.name}: {whereabouts_text(graph, where)}")
            if voice is not None and where.place != UNKNOWN:
                voice.say(f"you are in {spoken(where.place)}")


def _follow(answers: Answers, voice: _Aloud | None) -> None:
    announcer = Announcer()
    frames = placed = posed = 0
    for query, where in answers:
        frames += 1
        placed += where.place != UNKNOWN
        posed += where.T_world_camera is not None
        sentence = announcer.hear(where.place, query.frame.stamp_s)
        if sentence is not None:
            typer.echo(f"{query.frame.stamp_s:.2f} s: {sentence} ({where.sureness:.0%} sure)")
            if voice is not None:
                voice.say(sentence)
    typer.echo(f"{frames} frames: place found for {placed}, pose found for {posed}")


class _Aloud:
    """Speaks sentences until the voice fails."""

    def __init__(self) -> None:
        self._voice: Voice | None = None
        try:
            self._voice = Voice()
        except AppError as error:
            typer.echo(f"roomgraph: {error}", err=True)

    def say(self, sentence: str) -> None:
        """Speak a sentence, if the voice still works."""
        try:
            if self._voice is not None:
                self._voice.say(sentence)
        except AppError as error:
            typer.echo(f"roomgraph: {error}", err=True)
            self._voice = None
