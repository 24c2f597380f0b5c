"""What stands where: programmes of rooms, and the arranging of things in them."""
