"""Times and errors of methods, measured side by side in one run."""
