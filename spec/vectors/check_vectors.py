"""Hold answers to test vectors: python check_vectors.py VECTORS.json ANSWERS.json [--quantity NAME]
ANSWERS.json is a list (or {"rows": list}) of one object for each row, in order: {"layer_colours": …, …}."""

import json
import sys
from pathlib import Path

import numpy as np

TO_RGB = [3.2404542, -1.5371385, -0.4985314, -0.969266, 1.8760108, 0.041556, 0.0556434, -0.2040259, 1.0572252]
TO_XYZ = np.linalg.inv(np.reshape(TO_RGB, (3, 3)))


def ciede2000(rgb, other):
    """Return CIEDE2000 (n,) between linear Rec.709 colours (n, 3), negative channels cut to 0."""
    t = np.maximum([rgb, other], 0) @ TO_XYZ.T / TO_XYZ.sum(axis=1)
    x, y, z = np.moveaxis(np.where(t > (6 / 29) ** 3, np.cbrt(t), t * 841 / 108 + 4 / 29), -1, 0)
    light, a, b = 116 * y - 16, 500 * (x - y), 200 * (y - z)
    grey = np.hypot(a, b).mean(axis=0) ** 7
    p, q = a * (1.5 - 0.5 * np.sqrt(grey / (grey + 25**7))) + 1j * b
    c, turn = (abs(p) + abs(q)) / 2, np.angle(q * p.conj())
    h = np.where(abs(p * q) > 0, np.angle(p) + turn / 2, np.angle(p + q))
    t = 1 - 0.17 * np.cos(h - np.pi / 6) + 0.24 * np.cos(2 * h)
    t += 0.32 * np.cos(3 * h + np.pi / 30) - 0.2 * np.cos(4 * h - 0.35 * np.pi)
    bend = np.exp(-((np.degrees(h) % 360 / 25 - 11) ** 2))
    bend = -2 * np.sqrt(c**7 / (c**7 + 25**7)) * np.sin(np.pi / 3 * bend)
    off, light = (light.mean(axis=0) - 50) ** 2, light[1] - light[0]
    light, chroma = light / (1 + 0.015 * off / np.sqrt(20 + off)), (abs(q) - abs(p)) / (1 + 0.045 * c)
    hue = 2 * np.sqrt(abs(p * q)) * np.sin(turn / 2) / (1 + 0.015 * c * t)
    return np.sqrt(np.maximum(light**2 + chroma**2 + hue**2 + bend * chroma * hue, 0))


def check(rows, answers, name, rule):
    """Tell of the answers to one quantity; return whether all pass."""
    pairs = {i: (row["output"][name], answers[i][name]) for i, row in enumerate(rows) if name in answers[i]}
    pairs = {i: [np.array(x, float) for x in pair] for i, pair in pairs.items() if pair[0] not in (None, [])}
    if wrong := [i for i, (a, b) in pairs.items() if a.shape != b.shape] or ([] if pairs else "none"):
        raise ValueError(f"'{name}' has no answer where it has a value, or another shape; rows: {wrong}.")
    error = {i: np.nan_to_num(abs(answer - truth), nan=np.inf) for i, (truth, answer) in pairs.items()}
    over = {i: np.max(e / (rule["absolute"] + rule["relative"] * abs(pairs[i][0]))) for i, e in error.items()}
    told = f"{name}: {len(pairs)} rows, max abs error {max(map(np.max, error.values())):.2g}"
    if rule["colour"]:
        e = ciede2000(*(np.concatenate([p[k].reshape(-1, 3) for p in pairs.values()]) for k in (0, 1)))
        told += f", CIEDE2000 p95 {np.percentile(e, 95):.2g} max {np.max(e):.2g}"
    fail = sum(bool(x > 1) for x in over.values())
    sys.stdout.write(f"{told}, worst row {max(over, key=over.get)}, {fail or 'no'} rows fail\n")
    return max(over.values()) <= 1


if __name__ == "__main__":
    try:
        vectors, answers = (json.loads(Path(path).read_text("utf-8")) for path in sys.argv[1:3])
        rows, answers = vectors["rows"], answers["rows"] if isinstance(answers, dict) else answers
        answered = [name for name in vectors["tolerances"] if any(name in answer for answer in answers)]
        names = sys.argv[4:] if sys.argv[3:4] == ["--quantity"] else answered
        if len(rows) != len(answers) or not names:
            raise ValueError(f"{len(answers)} answers to {len(rows)} rows, to quantities {answered}.")
        sys.exit(sum(not check(rows, answers, name, vectors["tolerances"][name]) for name in names) > 0)
    except (OSError, ValueError, TypeError, KeyError, AttributeError) as problem:
        sys.exit(f"{__doc__}\nNot vectors and answers to them: {problem}")
