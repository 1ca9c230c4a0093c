"""Geometry, transforms, cameras, lights and environments as plain arrays."""
