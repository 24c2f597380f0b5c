"""One run from an opened sequence to a finished folder."""

from __future__ import annotations

import logging
from dataclasses import dataclass
from typing import Any

from threadpoolctl import threadpool_limits

from roomgraph.app.console import Terminal
from roomgraph.app.errors import AppError
from roomgraph.app.run.pipeline import Pipeline
from roomgraph.app.settings import AppSettings, write_settings
from roomgraph.app.storage.input import InputOptions, write_input
from roomgraph.app.storage.recorder import Recorder
from roomgraph.app.storage.run_folder import RunFolder
from roomgraph.app.viewer.viewer import NoViewer, Viewer
from roomgraph.datasets.camera import Camera, write_camera
from roomgraph.datasets.sequence import Sequence
from roomgraph.semantics.recognition.model import PlaceModel
from roomgraph.slam.checks import Examination, examine

logger = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class OutputOptions:
    """Optional outputs of a run: live in Rerun, as a recording, and as a report."""

    live: bool = False
    save: bool = True
    report: bool = True

    def check(self) -> None:
        """Raise an error before any work if the live viewer cannot open."""
        if self.live:
            from roomgraph.app.viewer.sinks import find_viewer

            find_viewer()


def map_sequence(
    sequence: Sequence,
    settings: AppSettings,
    model: PlaceModel | None,
    folder: RunFolder,
    outputs: OutputOptions,
    terminal: Terminal,
    options: InputOptions | None = None,
) -> dict[str, Any]:
    """Map and label a sequence into a run's folder; return the run's metrics.

    `options` say how the sequence was opened, if otherwise than by its path alone.
    """
    with terminal.logging(folder.log):
        settings = with_features_of(model, settings)
        write_settings(folder.config, settings)
        options = options or InputOptions(sequence=sequence.root)
        write_input(folder.input, options)
        logger.info("sequence %s, %d frames", sequence.root, len(sequence))
        for note in sequence.notes:
            logger.info("%s", note)
            terminal.say(note, dim=True)
        viewer = _viewer(folder, settings, outputs)  # is made while the sequence is checked
        found = _examine(sequence, settings, terminal)
        if found.sequence is not sequence:
            sequence = found.sequence
            _keep_camera(sequence.camera, folder, options, terminal)
        with terminal.progress(f"Mapping {sequence.name}") as advance:
            pipeline = Pipeline(
                sequence, settings, model=model, recorder=Recorder(folder), viewer=viewer,
                progress=advance, warnings=map(str, found.findings),
            )  # fmt: skip
            try:
                metrics = pipeline.run()
            except KeyboardInterrupt:
                say = f"`roomgraph report {folder.root}` and `roomgraph view {folder.root}`"
                terminal.say(f"The map so far is in {folder.root}; see it with {say}.")
                raise
        if outputs.report and metrics["frames_tracked"]:
            from roomgraph.app.report.page import write_report

            write_report(folder, sequence)
        logger.info("finished, see %s", folder.metrics.name)
    if not metrics["frames_tracked"]:
        raise AppError(
            "no frame could be tracked", where=sequence.root,
            expected="colour images with their depth images",
            hint="; ".join(map(str, found.findings))
            or "inspect the depth images, and check --depth-scale and --camera",
        )  # fmt: skip
    return metrics


def examined(sequence: Sequence, settings: AppSettings) -> Examination:
    """Check the sequence before it is mapped, and correct its camera where that is possible."""
    if not settings.checks.enabled:
        return Examination(sequence, ())
    # The matrices are small: BLAS threads would only get in the way of the checks' own.
    with threadpool_limits(1, user_api="blas"):
        return examine(sequence, settings.checks, settings.slam.noise)


def _examine(sequence: Sequence, settings: AppSettings, terminal: Terminal) -> Examination:
    """Check the sequence and print warnings."""
    with terminal.working("Checking the sequence (the first run also compiles, for some seconds)"):
        found = examined(sequence, settings)
    for finding in found.findings:
        logger.warning("%s: %s", finding.kind, finding)
        terminal.warn(str(finding))
    return found


def _keep_camera(
    camera: Camera, folder: RunFolder, options: InputOptions, terminal: Terminal
) -> None:
    """Write the corrected camera, to be used whenever the run's sequence is opened again."""
    write_camera(folder.camera, camera.intrinsics, camera.depth_scale, camera.depth)
    corrected = {"camera": folder.camera, "depth_scale": None}
    write_input(folder.input, options.model_copy(update=corrected))
    say = f"corrected camera written; use it for other sequences with --camera {folder.camera}"
    logger.info("%s", say)
    terminal.say(say, dim=True)


def with_features_of(model: PlaceModel | None, settings: AppSettings) -> AppSettings:
    """Use the feature settings of the place model, so that features are computed only once."""
    if model is None or model.features in (None, settings.slam.features):
        return settings
    logger.info("using the feature settings of the place model: %s", model.features)
    slam = settings.slam.model_copy(update={"features": model.features})
    return settings.model_copy(update={"slam": slam})


def _viewer(folder: RunFolder, settings: AppSettings, outputs: OutputOptions) -> Viewer:
    if not outputs.live and not outputs.save:
        return NoViewer()
    from roomgraph.app.viewer.threaded import ThreadedViewer

    def make() -> Viewer:
        from roomgraph.app.viewer.rerun import RerunViewer

        return RerunViewer(save, outputs.live, settings.viewer)

    save = folder.recording if outputs.save else None
    return ThreadedViewer(make)
