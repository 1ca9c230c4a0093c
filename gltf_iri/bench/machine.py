"""What a benchmark ran on: figures without it mean nothing."""

from __future__ import annotations

import os
import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, Final

__all__ = ["machine", "package_version"]

_CPU_INFO: Final = Path("/proc/cpuinfo")


def machine(packages: tuple[str, ...] = ()) -> dict[str, Any]:
    """Return the processor, whether it has AVX-512 (None where nobody tells), and versions."""
    lines = _CPU_INFO.read_text(encoding="utf-8").splitlines() if _CPU_INFO.exists() else []
    facts = {key.strip(): value.strip() for key, _, value in (line.partition(":") for line in lines)}
    flags = facts.get("flags", "").split()
    return {
        "processor": facts.get("model name") or platform.processor() or platform.machine(),
        "avx512": "avx512f" in flags if flags else None,
        "cores": os.cpu_count(),
        "system": platform.system(),
        "python": platform.python_version(),
        **{name: package_version(name) for name in ("numpy", "numba", *packages)},
    }


def package_version(package: str) -> str | None:
    """Return the installed version of what pip calls `package`, None where it is not installed."""
    try:
        return version(package)
    except PackageNotFoundError:
        return None
