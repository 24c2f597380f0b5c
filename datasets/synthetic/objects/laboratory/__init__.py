"""Laboratory things: benches, instruments, hoods, racks."""
