"""Two results held against each other: what differs, by how much, under which white."""
