"""What a building is made of: walls, doors, stairs, elevators."""
