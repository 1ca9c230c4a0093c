"""The rules about what buffers hold; the code is in `gltf_iri.validation.data`."""

from __future__ import annotations

from gltf_iri.validation.data.bind_matrices import bind_matrices_are_affine
from gltf_iri.validation.data.bounds import accessors_hold_what_they_say, sparse_indices_increase
from gltf_iri.validation.data.indices import indices_name_vertices
from gltf_iri.validation.data.keyframes import rotations_are_of_length_1, times_increase
from gltf_iri.validation.data.vertices import vertices_are_of_length_1_or_clamped
from gltf_iri.validation.data.weights import weights_of_joints_add_up
from gltf_iri.validation.rules.registry import Rules

__all__ = ["DATA_RULES", "RULES"]

RULES: Rules = {}
DATA_RULES: Rules = {
    "accessor": (sparse_indices_increase, accessors_hold_what_they_say),
    "mesh.primitive": (indices_name_vertices, vertices_are_of_length_1_or_clamped, weights_of_joints_add_up),
    "animation.sampler": (times_increase,),
    "animation.channel": (rotations_are_of_length_1,),
    "skin": (bind_matrices_are_affine,),
}
