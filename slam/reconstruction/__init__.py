"""The map: points, meshes, free space and the floor."""
