"""Conditions choose lines as the GLSL preprocessor would, and refuse what it would pass over in silence."""

from __future__ import annotations

import itertools

import pytest

from gltf_iri.rendering.conditions import Conditions, evaluate_condition, is_directive

A, B = "HAS_METAL", "HAS_DIELECTRIC"

FORMS = {
    f"defined({A})": lambda a, b: a,
    f"defined {A}": lambda a, b: a,
    f"!defined({A})": lambda a, b: not a,
    f"defined({A}) && defined({B})": lambda a, b: a and b,
    f"defined({A}) || defined({B})": lambda a, b: a or b,
    f"!defined({A}) || defined({B}) && defined({A})": lambda a, b: (not a) or (b and a),
    f"!(defined({A}) || defined({B}))": lambda a, b: not (a or b),
}


@pytest.mark.parametrize("text", FORMS)
@pytest.mark.parametrize(("a", "b"), list(itertools.product([False, True], repeat=2)))
def test_condition_has_the_truth_of_its_formula(text: str, a: bool, b: bool) -> None:
    defined = {name for name, is_set in ((A, a), (B, b)) if is_set}
    assert evaluate_condition(text, defined) == FORMS[text](a, b)


@pytest.mark.parametrize(
    "text",
    [
        "defined(HAS_MEATL)",
        "LIGHT_COUNT > 0",
        f"defined({A}) defined({B})",
        f"(defined({A})",
        "",
        "!",
        f"{A}",
    ],
)
def test_condition_that_is_no_formula_of_switches_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"."):
        evaluate_condition(text, {A})


def chosen(text: str, defined: set[str]) -> list[str]:
    conditions = Conditions(defined)
    lines = []
    for line in text.splitlines():
        if is_directive(line):
            conditions.step(line)
        elif conditions.active:
            lines.append(line)
    assert conditions.balanced
    return lines


NESTED = f"""\
#ifdef {A}
metal
#  ifndef {B}
only metal
#  endif
#elif defined({B})
only dielectric
#else
neither
#endif // {A}
always"""


@pytest.mark.parametrize(
    ("defined", "lines"),
    [
        ({A}, ["metal", "only metal", "always"]),
        ({A, B}, ["metal", "always"]),
        ({B}, ["only dielectric", "always"]),
        (set(), ["neither", "always"]),
    ],
)
def test_exactly_one_branch_is_taken(defined: set[str], lines: list[str]) -> None:
    assert chosen(NESTED, defined) == lines


@pytest.mark.parametrize(
    "text",
    ["#endif", "#else", f"#elif defined({A})", f"#ifdef {A}\n#else\n#else", f"#ifdef {A}\n#else\n#elif x"],
)
def test_misplaced_directive_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"without #if|after #else"):
        chosen(text, set())


def test_other_preprocessor_lines_are_left_to_the_driver() -> None:
    assert not is_directive("#define HAS_METAL")
    assert not is_directive('#include "common/math.glsl"')
    assert not is_directive("// #ifdef HAS_METAL")
