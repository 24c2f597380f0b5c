"""The semantic layer: visual words, place labels and the semantic topological graph."""
