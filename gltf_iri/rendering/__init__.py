"""The only folder that talks to OpenGL."""
