"""``roomgraph synth``: render a sequence of a synthetic building."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from roomgraph.app.cli import options


def synth(
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="DIR", help="Folder of the sequence.")
    ],
    seed: Annotated[int, typer.Option("--seed", min=0, help="Seed of the building.")] = 0,
    light: Annotated[str, typer.Option("--light", help="Light: day, dusk or night.")] = "day",
    noise: Annotated[
        float, typer.Option("--noise", min=0, help="Noise of both images: 1 as a Kinect, 0 none.")
    ] = 1.0,
    step: Annotated[
        float, typer.Option("--step", metavar="M", help="Distance between two frames, metres.")
    ] = 0.08,
    laps: Annotated[
        int, typer.Option("--laps", min=1, help="Number of laps around the floor.")
    ] = 1,
    frames: options.FramesOption = None,
    width: Annotated[int, typer.Option("--width", help="Image width, pixels.")] = 640,
    height: Annotated[int, typer.Option("--height", help="Image height, pixels.")] = 480,
    overwrite: options.OverwriteOption = False,
    quiet: options.QuietOption = False,
) -> None:
    """Render a walk through a synthetic office floor.

    Writes a TUM sequence with ground-truth poses and room labels: rgb/, depth/, camera.json,
    groundtruth.txt and places.csv.

    Examples:

      roomgraph synth -o floor7 --seed 7

      roomgraph synth -o floor7_night --seed 7 --light night --laps 2
    """
    from roomgraph.app.console import Terminal
    from roomgraph.app.storage.building_cache import building_settings, render
    from roomgraph.app.storage.run_folder import clear_output

    terminal = Terminal(quiet)
    settings = building_settings(
        seed=seed,
        light=light,
        noise=noise,
        step_m=step,
        laps=laps,
        frames=frames,
        width=width,
        height=height,
    )
    clear_output(output, overwrite, ("building.json", "places.csv"))
    render({settings.light: output}, settings, terminal)
    terminal.say(f"Written to {output}; map it with: roomgraph run {output}")
