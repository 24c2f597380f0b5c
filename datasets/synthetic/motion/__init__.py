"""How the camera is carried, and what an IMU and wheels measure on the way."""
