"""The broken and hostile files as code, by what is wrong with them; `write.py` writes them."""
