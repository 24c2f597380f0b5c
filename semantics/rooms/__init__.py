"""Rooms from the free space of the map: regions, outlines, doorways."""
