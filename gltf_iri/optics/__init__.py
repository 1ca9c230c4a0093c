"""The physics, one phenomenon a file, twins of shaders/optics/*.glsl."""
