"""The walks of the experiments: rendered buildings from the cache, or the user's folders."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from roomgraph.app.console import Terminal
from roomgraph.app.learning.training import labelled_examples
from roomgraph.app.storage.building_cache import building_settings, cached
from roomgraph.datasets.readers.registry import open_sequence
from roomgraph.datasets.synthetic.settings import LIGHTS
from roomgraph.semantics.recognition.examples import Example, sequence_examples

# Six buildings to experiment on, and one to learn descriptors from. The demonstration uses others.
SEEDS, DESCRIPTOR_SEED = (20, 21, 22, 23, 24, 25), 26
# Small images, wide steps: the experiments compare views, they do not track. One image in four of
# a walk is learned from or tested, so that hardly two are alike.
WALK = {"width": 320, "height": 240, "step_m": 0.16, "turn_deg": 8.0}
STRIDE = 4


@dataclass(frozen=True, slots=True)
class Walk:
    """Images of one building, or of one folder, in one light."""

    building: str
    light: str
    examples: list[Example]

    @property
    def root(self) -> Path:
        """The sequence that the images are from; the file of a single photograph."""
        return Path(self.examples[0].session)


def rendered_walks(seeds: Sequence[int], terminal: Terminal) -> list[Walk]:
    """Return the walks through rendered buildings in every light, rendering what is missing."""
    walks = []
    for seed in seeds:
        roots = cached(LIGHTS, building_settings(seed=seed, **WALK), terminal)
        for light, root in zip(LIGHTS, roots, strict=True):
            walks.append(Walk(f"building{seed}", light, sequence_examples(open_sequence(root))))
    return walks


def data_walks(roots: Sequence[Path]) -> list[Walk]:
    """Return the user's folders or sequences, each as a separate building and light."""
    return [Walk(root.name, root.name, labelled_examples(root)) for root in roots]
