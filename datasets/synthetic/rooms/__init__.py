"""What the kinds of rooms are made of and furnished with."""
