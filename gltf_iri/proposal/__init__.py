"""Checks a proposal for a glTF extension: its schemas, its README, and that both say the same."""
