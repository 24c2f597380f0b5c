"""Classes by name: how the exchangeable parts of the program are listed."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import Any

from pydantic import create_model

from roomgraph.datasets.settings import Settings


def classes_by_name(package: str, *entries: str) -> dict[str, Any]:
    """Return the classes that entries ``module.Class`` of a package stand for, by their `name`.

    Parameters
    ----------
    package : str
        The package that the modules are in.
    entries : str
        ``module.Class``, one for each class; each class has a ``name``.

    Raises
    ------
    ValueError
        Two classes have the same name.
    """
    classes: dict[str, Any] = {}
    for entry in entries:
        module, _, attribute = entry.partition(".")
        found = getattr(import_module(f"{package}.{module}"), attribute)
        if found.name in classes:
            raise ValueError(f"{package}: two classes are called {found.name!r}")
        classes[found.name] = found
    return classes


def known_name(name: str, classes: Mapping[str, Any]) -> str:
    """Return a name that one of the classes has; for validators of settings.

    Raises
    ------
    ValueError
        No class has that name.
    """
    if name not in classes:
        raise ValueError(f"one of {', '.join(classes)}")
    return name


def settings_by_name(title: str, module: str, classes: Mapping[str, Any]) -> type[Settings]:
    """Return a settings model with a part for each class: its ``settings_class`` under its name.

    Parameters
    ----------
    title, module : str
        Name of the model, and of the module that keeps it: so other processes find it.
    classes : mapping of str to class
        As from `classes_by_name`.
    """
    parts: dict[str, Any] = {
        name: (found.settings_class, found.settings_class()) for name, found in classes.items()
    }
    return create_model(title, __base__=Settings, __module__=module, **parts)
