"""Floor plans: rooms, doorways, levels; a file a family."""
