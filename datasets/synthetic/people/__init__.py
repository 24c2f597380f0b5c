"""People who walk and sit in the building."""
