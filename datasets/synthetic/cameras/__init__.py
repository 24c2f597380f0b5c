"""What cameras make of a scene: depth sensors, photographs, an omnidirectional mirror."""
