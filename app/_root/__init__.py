"""RGB-D mapping and semantic SLAM: a labelled 3-D map and a graph of the rooms.

The public names are listed in ``__init__.pyi`` and are imported when first used.
"""

from importlib.metadata import version

import lazy_loader

__version__ = version("roomgraph")
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
