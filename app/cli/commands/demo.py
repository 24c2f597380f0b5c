"""``roomgraph demo``: train, map and label on rendered buildings."""

from __future__ import annotations

from roomgraph.app.cli import options


def demo(
    output: options.OutputOption = None,
    visualize: options.VisualizeOption = False,
    save_rrd: options.SaveRrdOption = True,
    report: options.ReportOption = True,
    seed: options.SeedOption = None,
    overwrite: options.OverwriteOption = False,
    quiet: options.QuietOption = False,
    verbose: options.VerboseOption = False,
) -> None:
    """Train, map and label on rendered buildings; needs no data.

    Renders two office floors (stored in a cache), trains a place model on one of them by day and
    by night, then maps the other one and labels its rooms.

    Examples:

      roomgraph demo

      roomgraph demo -o out --visualize
    """
    from roomgraph.app.console import Terminal
    from roomgraph.app.report.figures import summary
    from roomgraph.app.run.demo import run_demo
    from roomgraph.app.run.session import OutputOptions
    from roomgraph.app.settings import load_settings

    terminal = Terminal(quiet, verbose)
    settings = load_settings(None, {"seed": seed})
    outputs = OutputOptions(visualize, save_rrd, report)
    folder, metrics = run_demo(settings, output, overwrite, outputs, terminal)
    terminal.say(summary(metrics))
    if report:
        terminal.say(f"Report: {folder.report}")
    terminal.say(f"View it with: roomgraph view {folder.root}")
    terminal.say(
        f"Label your own sequence with its model: roomgraph run SEQUENCE --model {folder.model}"
    )
