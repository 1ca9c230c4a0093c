"""The tables held against the JSON, the links between its objects, and what nothing refers to."""
