"""Lets this folder's tests import the laws and their verdicts, which stand in modules beside them."""

from __future__ import annotations

import sys
from pathlib import Path

# At the end: no module of another folder is hidden.
sys.path.append(str(Path(__file__).resolve().parent))
