"""Place models: learned from labelled data, applied to images, taught by corrections."""
