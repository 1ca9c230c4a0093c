"""Fills tables of a material's colour from the truth, keeps them on disk, and looks colours up in them."""
