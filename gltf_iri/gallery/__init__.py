"""Many files on one page: a small picture of each, its plan, and how far it is from the truth."""
