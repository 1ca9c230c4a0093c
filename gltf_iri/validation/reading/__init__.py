"""Bytes to JSON, with remarks instead of errors."""
