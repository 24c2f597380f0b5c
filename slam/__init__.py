"""SLAM: camera motion, planes, loops, pose graph and map."""
