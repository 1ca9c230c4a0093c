"""Is this file right: the Khronos verdict on a glTF file, and what its optics make of it."""
