"""An image as a vector."""
