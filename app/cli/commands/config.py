"""``roomgraph config``: print the default settings."""

from __future__ import annotations

from roomgraph.app.cli import options


def config(config: options.ConfigOption = None) -> None:
    """Print all settings with their meaning, as TOML.

    Examples:

      roomgraph config > settings.toml

      roomgraph run SEQUENCE --config settings.toml
    """
    import typer

    from roomgraph.app.settings import load_settings, to_commented_toml

    typer.echo(to_commented_toml(load_settings(config)), nl=False)
