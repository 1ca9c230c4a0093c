"""Untrusted bytes to checked JSON, buffers and pixels: the only folder that touches files and URIs."""
