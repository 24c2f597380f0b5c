"""Place models: trained on labelled data, applied to images, extended by corrections."""
