"""Chooses for each material the cheapest way to its film whose error stays within a budget."""
