"""The low layer: camera motion, planes, loops, pose graph and map."""
