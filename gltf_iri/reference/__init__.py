"""Casts rays and shades in float64: the same scene, without OpenGL and without the shaders' code."""
