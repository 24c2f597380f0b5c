"""Place models: labelled images, training, saving, prediction."""
