"""The rooms of the corridor plan, as the first version furnished them."""
