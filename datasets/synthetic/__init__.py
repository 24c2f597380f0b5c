"""The rendered building: a procedural office floor, its camera walk and its ground truth."""
