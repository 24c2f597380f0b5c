"""Office things: desks, cabinets, boards, copiers."""
