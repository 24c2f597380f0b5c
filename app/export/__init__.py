"""Export of a run's outputs to formats of other tools, a file for each kind of output."""
