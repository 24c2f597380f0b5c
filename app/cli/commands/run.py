"""``roomgraph run``: map and label a sequence."""

from __future__ import annotations

from roomgraph.app.cli import options


@options.grouped
def run(
    sequence: options.SequenceArgument,
    output: options.OutputOption = None,
    model: options.ModelOption = None,
    *,
    opening: options.InputFlags,
    tuning: options.SettingFlags,
    visualize: options.VisualizeOption = False,
    save_rrd: options.SaveRrdOption = True,
    report: options.ReportOption = True,
    overwrite: options.OverwriteOption = False,
    quiet: options.QuietOption = False,
    verbose: options.VerboseOption = False,
) -> None:
    """Map and label an RGB-D sequence.

    Estimates the camera's trajectory, builds a coloured map and, with a place model, labels each
    part with its kind of place. Writes a run folder: trajectory, map, topological graph, metrics
    and a Rerun recording.

    Examples:

      roomgraph run rgbd_dataset_freiburg1_room -o out

      roomgraph run my_recording --model places --visualize

      roomgraph run frames/ --dataset folder --camera camera.json --depth-scale 1000
    """
    from roomgraph.app.console import Terminal
    from roomgraph.app.report.figures import summary
    from roomgraph.app.run.session import OutputOptions, map_sequence
    from roomgraph.app.storage.run_folder import make_run_folder
    from roomgraph.semantics.recognition.model_files import load_model

    terminal = Terminal(quiet, verbose)
    settings, source = tuning.load(), opening.of(sequence)
    opened = source.open()
    places = load_model(model) if model is not None else None
    outputs = OutputOptions(visualize, save_rrd, report)
    outputs.check()
    folder = make_run_folder(output, opened.name, overwrite)
    metrics = map_sequence(
        opened,
        settings,
        model=places,
        folder=folder,
        outputs=outputs,
        terminal=terminal,
        options=source,
    )
    terminal.say(summary(metrics))
    if report:
        terminal.say(f"Report: {folder.report}")
    terminal.say(f"Written to {folder.root}; view it with: roomgraph view {folder.root}")
