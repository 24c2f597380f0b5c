"""What makes a room lived in: plants, pictures, textiles, toys, lamps."""
