"""JSON to frozen dataclasses with physical units; only this folder knows glTF's material names."""
