"""The codes for what KHR_animation_pointer asks of pointers and of the values that they receive."""

from __future__ import annotations

from gltf_iri.validation.issue import ERROR, WARNING

__all__ = ["POINTER_CODES"]

POINTER_CODES: dict[str, tuple[int, str]] = {
    "IRI_POINTER_MISSING": (WARNING, "The path is 'pointer', but no KHR_animation_pointer says to what."),
    # Readers pass over such a channel, and a file that plays everywhere is no broken one: warnings.
    "IRI_POINTER_UNDEFINED": (WARNING, "The pointer {target} leads to nothing: {reason}."),
    "IRI_POINTER_NOT_MUTABLE": (ERROR, "What {target} leads to cannot be animated: {reason}."),
    "IRI_POINTER_NODE_MATRIX": (ERROR, "A node with a matrix has no {property} that could be animated."),
    "IRI_POINTER_REPEATED": (WARNING, "{target} is animated by channel {first} already."),
    "IRI_POINTER_OUTPUT_TYPE": (ERROR, "The type for {target} is {found}, not {wanted}."),
    "IRI_POINTER_OUTPUT_COUNT": (ERROR, "The count is {found}, but {target} calls for {wanted}."),
    "IRI_POINTER_INTERPOLATION": (
        ERROR,
        "What is true or false cannot be interpolated by {found}: use STEP.",
    ),
    "IRI_POINTER_VALUE": (
        ERROR,
        "Values for {target} must lie in {range}; the first of {count} outside is {value}, at {index}.",
    ),
}
