"""What the asset names: buffers and pictures, from URIs, buffer views and the BIN chunk."""
