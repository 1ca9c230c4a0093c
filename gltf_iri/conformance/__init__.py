"""Test vectors for implementers: rows of inputs and of what they must give, truth to nine decimals."""
