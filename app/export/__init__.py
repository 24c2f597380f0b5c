"""A run's products in the formats of other tools, a file for each kind of product."""
