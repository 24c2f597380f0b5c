"""``roomgraph demo``: the whole job on rendered buildings."""

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
    """Do the whole job on rendered buildings; needs no data.

    Renders two office floors (kept in a cache), learns the places of one by day and by night,
    then maps and labels the other, which it has never seen.

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
    terminal.say(f"Look at it with: roomgraph view {folder.root}")
    terminal.say(f"Label your own with its places: roomgraph run SEQUENCE --model {folder.model}")
