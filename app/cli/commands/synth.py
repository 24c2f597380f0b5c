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
    plan: Annotated[
        str,
        typer.Option("--plan", help="Floor plan: corridor, ring, suite, open or house."),
    ] = "corridor",
    floors: Annotated[
        int, typer.Option("--floors", min=1, help="Floors, joined by stairs and an elevator.")
    ] = 1,
    visit: Annotated[
        int,
        typer.Option(
            "--visit", min=0, help="A later visit: furniture moved, doors and lights changed."
        ),
    ] = 0,
    people: Annotated[
        int, typer.Option("--people", min=0, help="People who walk and sit in the building.")
    ] = 0,
    light: Annotated[str, typer.Option("--light", help="Light: day, dusk or night.")] = "day",
    sensor: Annotated[
        str, typer.Option("--sensor", help="Depth camera: kinect, stereo, tof or clean.")
    ] = "kinect",
    hand: Annotated[
        bool,
        typer.Option("--hand", help="Hand-held: tremor, fast turns, blur, a covered lens."),
    ] = False,
    optics: Annotated[
        str | None,
        typer.Option(
            "--optics",
            help="Colour camera: ideal, or real (motion blur, rolling shutter, exposure). "
            "Default: real with --hand, stereo and tof.",
            show_default=False,
        ),
    ] = None,
    omni: Annotated[
        bool, typer.Option("--omni", help="Add images of an omnidirectional helmet camera.")
    ] = False,
    imu: Annotated[
        bool, typer.Option("--imu", help="Add imu.csv (200 Hz) and odometry.txt (wheels).")
    ] = False,
    noise: Annotated[
        float, typer.Option("--noise", min=0, help="Noise of both images: 1 as real, 0 none.")
    ] = 1.0,
    step: Annotated[
        float | None,
        typer.Option(
            "--step",
            metavar="M",
            help="Distance between two frames, metres.  [default: 0.08; 0.035 with --hand]",
            show_default=False,
        ),
    ] = None,
    laps: Annotated[
        int, typer.Option("--laps", min=1, help="Number of laps around the building.")
    ] = 1,
    frames: options.FramesOption = None,
    width: Annotated[int, typer.Option("--width", help="Image width, pixels.")] = 640,
    height: Annotated[int, typer.Option("--height", help="Image height, pixels.")] = 480,
    sheet: Annotated[
        bool,
        typer.Option(
            "--sheet", help="Write a page of pictures (every room by day and night, plans) only."
        ),
    ] = False,
    overwrite: options.OverwriteOption = False,
    quiet: options.QuietOption = False,
) -> None:
    """Render a walk through a synthetic building.

    Writes a TUM sequence with ground-truth poses and room labels: rgb/, depth/, camera.json,
    groundtruth.txt, places.csv, building.json; and, for all but the plain corridor walk, the
    objects (objects.csv) and the boxes around them (boxes.csv).

    Examples:

      roomgraph synth -o floor7 --seed 7

      roomgraph synth -o floor7_night --seed 7 --light night --laps 2

      roomgraph synth -o home --plan house --floors 2 --people 2 --sensor stereo --hand --imu

      roomgraph synth -o home_later --plan house --floors 2 --visit 1

      roomgraph synth -o pages --plan ring --sheet
    """
    from roomgraph.app.console import Terminal
    from roomgraph.app.storage.building_cache import building_settings, draw_sheet, render
    from roomgraph.app.storage.run_folder import clear_output

    terminal = Terminal(quiet)
    given = {"step_m": step} if step is not None else {}
    settings = building_settings(
        seed=seed,
        plan=plan,
        floors=floors,
        visit=visit,
        people=people,
        light=light,
        sensor=sensor,
        hand=hand,
        optics=optics,
        omni=omni,
        imu=imu,
        noise=noise,
        laps=laps,
        frames=frames,
        width=width,
        height=height,
        **given,
    )
    if sheet:
        terminal.say(f"Written to {draw_sheet(output, settings, overwrite, terminal)}")
        return
    clear_output(output, overwrite, ("building.json", "places.csv"))
    render({settings.light: output}, settings, terminal)
    terminal.say(f"Written to {output}; map it with: roomgraph run {output}")
