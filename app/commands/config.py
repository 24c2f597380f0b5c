"""``roomgraph config``: print the default settings."""

from __future__ import annotations

from app import options


def config(config: options.ConfigOption = None) -> None:
    """Print all settings as TOML, each with its meaning.

    Examples:

      roomgraph config > settings.toml

      roomgraph run SEQUENCE --config settings.toml
    """
    import typer

    from app.config import load_settings, to_commented_toml

    typer.echo(to_commented_toml(load_settings(config)), nl=False)
