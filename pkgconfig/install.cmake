# The installed package: written by its own room.
