"""The command line: one verb a file, thin; nothing here computes."""
