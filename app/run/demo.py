"""The demonstration: train on one rendered building, map and label another."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from roomgraph.app.console import Terminal
from roomgraph.app.learning.training import train_model
from roomgraph.app.run.session import OutputOptions, map_sequence
from roomgraph.app.settings import AppSettings
from roomgraph.app.storage.building_cache import building_settings, cached
from roomgraph.app.storage.run_folder import RUN_MARKS, RunFolder, clear_output, make_run_folder
from roomgraph.datasets.readers.registry import open_sequence
from roomgraph.semantics.recognition.model_files import save_model


def run_demo(
    settings: AppSettings,
    output: Path | None,
    overwrite: bool,
    outputs: OutputOptions,
    terminal: Terminal,
) -> tuple[RunFolder, dict[str, Any]]:
    """Run the demonstration; return its run folder and metrics.

    Trains on building ``2 * seed`` by day and night, and maps building ``2 * seed + 1``.
    The place model is kept in the run's folder.
    """
    outputs.check()
    if output is not None:
        clear_output(output, overwrite, RUN_MARKS)
    known = building_settings(seed=2 * settings.seed)
    strange = building_settings(seed=2 * settings.seed + 1)
    exemplars = cached(("day", "night"), known, terminal)
    (strange_floor,) = cached(("day",), strange, terminal)
    model = train_model(exemplars, settings, terminal)
    terminal.say(
        f"Trained on {sum(model.training['images'].values())} images; "
        f"accuracy on held-out visits: {model.training['cross_validated_accuracy']:.1%}",
        dim=True,
    )
    sequence = open_sequence(strange_floor)
    folder = make_run_folder(output, sequence.name, overwrite=False)
    save_model(folder.model, model)
    return folder, map_sequence(
        sequence, settings, model=model, folder=folder, outputs=outputs, terminal=terminal
    )
