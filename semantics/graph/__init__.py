"""The semantic topological graph: nodes, instances, routes, corrections and files."""
