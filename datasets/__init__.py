"""Frames, cameras, trajectories, readers and the rendered building: what comes in."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
