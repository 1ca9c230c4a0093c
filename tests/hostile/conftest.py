"""Lets the tests of this folder import what writes and walks the files."""

from __future__ import annotations

import sys
from pathlib import Path

# At the end: no module of another folder is hidden.
sys.path.append(str(Path(__file__).resolve().parent))
