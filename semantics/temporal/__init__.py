"""Labels over time: one image's prediction among its neighbours."""
