"""What the buffers hold: element by element, but by aggregates of blocks where nothing is wrong."""
