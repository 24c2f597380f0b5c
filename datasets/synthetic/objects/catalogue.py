"""The models of all packages by their names, which are unique."""

from __future__ import annotations

from collections.abc import Callable
from types import ModuleType

from roomgraph.datasets.synthetic.objects.bathroom import (
    basins,
    fittings,
    laundry,
    toilets,
    towels,
    tubs,
)
from roomgraph.datasets.synthetic.objects.decor import (
    aquarium,
    clocks,
    lamps,
    pictures,
    plants,
    shelves,
    sport,
    textiles,
    toys,
)
from roomgraph.datasets.synthetic.objects.home import (
    beds,
    bookcases,
    chairs,
    chests,
    fireplace,
    piano,
    sofas,
    stools,
    table_sets,
    tables,
    television,
    wardrobes,
)
from roomgraph.datasets.synthetic.objects.kitchen import (
    appliances,
    bottles,
    cookers,
    counter,
    crockery,
    island,
    small_appliances,
)
from roomgraph.datasets.synthetic.objects.laboratory import (
    benches,
    gas,
    hoods,
    instruments,
    lab_stools,
    racks,
    sinks,
)
from roomgraph.datasets.synthetic.objects.look import Look
from roomgraph.datasets.synthetic.objects.office import (
    boards,
    cabinets,
    desk_things,
    desks,
    machines,
    office_chairs,
    printers,
    standing,
)
from roomgraph.datasets.synthetic.objects.service import (
    bicycle,
    boxes,
    cleaning,
    cloakroom,
    fixtures,
    ladder,
    lockers,
    signs,
    storage,
    suitcase,
    vending,
)
from roomgraph.datasets.synthetic.rendering.stand import Stand

Model = Callable[..., None]
# The files with models, a line or two a package: bathroom to service.
FILES: tuple[ModuleType, ...] = (
    basins, fittings, laundry, toilets, towels, tubs,
    aquarium, clocks, lamps, pictures, plants, shelves, sport, textiles, toys,
    beds, bookcases, chairs, chests, fireplace, piano, sofas, stools, table_sets, tables,
    television, wardrobes,
    appliances, bottles, cookers, counter, crockery, island, small_appliances,
    benches, gas, hoods, instruments, lab_stools, racks, sinks,
    boards, cabinets, desk_things, desks, machines, office_chairs, printers, standing,
    bicycle, boxes, cleaning, cloakroom, fixtures, ladder, lockers, signs, storage, suitcase,
    vending,
)  # fmt: skip


def _register() -> dict[str, Model]:
    """Map the names in each file's ``__all__`` to what builds them."""
    found: dict[str, Model] = {}
    for file in FILES:
        for name in file.__all__:
            if name in found:
                raise ValueError(f"two models are called {name!r}")
            found[name] = getattr(file, name)
    return found


MODELS = _register()


def _model(name: str) -> Model:
    if name not in MODELS:
        raise ValueError(f"unknown model {name!r}; there are {', '.join(MODELS)}")
    return MODELS[name]


def build_model(name: str, stand: Stand, look: Look, **options: float | int | str) -> None:
    """Build a model at a stand; an unknown name is a `ValueError`."""
    _model(name)(stand, look, **options)


def models() -> tuple[str, ...]:
    """Return the names of all models."""
    return tuple(MODELS)


def package_of(name: str) -> str:
    """Return the package that a model is in: the sort of place it belongs to."""
    return _model(name).__module__.split(".")[-2]
