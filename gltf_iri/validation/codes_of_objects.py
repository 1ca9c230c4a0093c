"""The Khronos codes of what one object says by itself: severity and our sentence."""

from __future__ import annotations

from gltf_iri.validation.issue import ERROR, INFORMATION, WARNING

__all__ = ["CODES_OF_OBJECTS"]

CODES_OF_OBJECTS: dict[str, tuple[int, str]] = {
    # Reading
    "IO_ERROR": (ERROR, "The file cannot be read: {reason}."),
    # The schema of each object
    "ARRAY_LENGTH_NOT_IN_LIST": (ERROR, "The array has {length} items; it may have {allowed}."),
    "ARRAY_TYPE_MISMATCH": (ERROR, "The item {value} is not {wanted}."),
    "DUPLICATE_ELEMENTS": (ERROR, "The item stands in the array before."),
    "EMPTY_ENTITY": (ERROR, "It is empty; leave it out."),
    "INVALID_INDEX": (ERROR, "An index is an integer from 0 on."),
    "INVALID_JSON": (ERROR, "The JSON is broken: {reason}."),
    "INVALID_URI": (ERROR, "The URI {uri} is broken: {reason}."),
    "ONE_OF_MISMATCH": (ERROR, "Exactly one of {properties} must be there."),
    "PATTERN_MISMATCH": (ERROR, "The text {value} does not have the form {pattern}."),
    "TYPE_MISMATCH": (ERROR, "The value {value} is not {wanted}."),
    "UNDEFINED_PROPERTY": (ERROR, "The property {property!r} is missing."),
    "UNEXPECTED_PROPERTY": (
        WARNING,
        "glTF knows no such property here; applications keep theirs in 'extras'.",
    ),
    "UNSATISFIED_DEPENDENCY": (ERROR, "The property means nothing without {property!r}, which is missing."),
    "VALUE_MULTIPLE_OF": (ERROR, "The value {value} is not a multiple of {factor}."),
    "VALUE_NOT_IN_LIST": (WARNING, "The value {value} is none of {allowed}."),
    "VALUE_NOT_IN_RANGE": (ERROR, "The value {value} is outside {range}."),
    # The meaning of each object
    "ACCESSOR_MATRIX_ALIGNMENT": (ERROR, "Matrices must start on multiples of 4 bytes."),
    "ACCESSOR_NORMALIZED_INVALID": (ERROR, "Only 8- and 16-bit integers can be normalized."),
    "ACCESSOR_OFFSET_ALIGNMENT": (
        ERROR,
        "The offset {start} is not a multiple of the component's {size} bytes.",
    ),
    "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE": (
        ERROR,
        "{count} sparse elements replace those of an accessor of {total}.",
    ),
    "ANIMATION_CHANNEL_TARGET_NODE_SKIN": (
        WARNING,
        "The node's mesh is skinned: moving the node does not move it.",
    ),
    "ASSET_MIN_VERSION_GREATER_THAN_VERSION": (
        ERROR,
        "The minVersion {minimum} is greater than the version {version}.",
    ),
    "BUFFER_DATA_URI_MIME_TYPE_INVALID": (
        ERROR,
        "A buffer's data URI is application/octet-stream or application/gltf-buffer, not {media_type}.",
    ),
    "BUFFER_VIEW_INVALID_BYTE_STRIDE": (
        ERROR,
        "Only a buffer view of vertex attributes may have a byteStride.",
    ),
    "BUFFER_VIEW_TOO_BIG_BYTE_STRIDE": (
        ERROR,
        "The byteStride {stride} is greater than the byteLength {length}.",
    ),
    "CAMERA_XMAG_YMAG_NEGATIVE": (WARNING, "A negative magnification mirrors the picture."),
    "CAMERA_XMAG_YMAG_ZERO": (ERROR, "A magnification of 0 shows nothing."),
    "CAMERA_YFOV_GEQUAL_PI": (WARNING, "The field of view must be less than π."),
    "CAMERA_ZFAR_LEQUAL_ZNEAR": (ERROR, "zfar must be greater than znear."),
    "EXTRA_PROPERTY": (INFORMATION, "The property is not used here; leave it out."),
    "INVALID_EXTENSION_NAME_FORMAT": (
        WARNING,
        "An extension's name is a prefix in capitals, '_', and a name.",
    ),
    "INVALID_GL_VALUE": (ERROR, "The value {value} does not fit the component type {type}."),
    "KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_NODE": (
        ERROR,
        "A pointer's target must not name a node.",
    ),
    "KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_PATH": (
        ERROR,
        "A pointer's path is 'pointer', not {path}.",
    ),
    "KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES": (
        ERROR,
        "The outer angle {outer} must be greater than the inner, {inner}.",
    ),
    "KHR_MATERIALS_ANISOTROPY_ANISOTROPY_TEXTURE_TEXCOORD": (
        WARNING,
        "Normal and anisotropy texture should use one UV set: both turn with its tangents.",
    ),
    "KHR_MATERIALS_CLEARCOAT_CLEARCOAT_NORMAL_TEXTURE_TEXCOORD": (
        WARNING,
        "Normal and clearcoat normal texture should use one UV set: both turn with its tangents.",
    ),
    "KHR_MATERIALS_DISPERSION_NO_VOLUME": (WARNING, "Dispersion does nothing without KHR_materials_volume."),
    "KHR_MATERIALS_EMISSIVE_STRENGTH_ZERO_FACTOR": (
        WARNING,
        "The strength multiplies an emissiveFactor of 0.",
    ),
    "KHR_MATERIALS_IRIDESCENCE_THICKNESS_RANGE_WITHOUT_TEXTURE": (
        INFORMATION,
        "Without a thickness texture the maximum alone counts; the minimum does nothing.",
    ),
    "KHR_MATERIALS_IRIDESCENCE_THICKNESS_TEXTURE_UNUSED": (
        INFORMATION,
        "The thickness texture chooses between a minimum and a maximum that are equal.",
    ),
    "KHR_MATERIALS_VOLUME_DOUBLE_SIDED": (
        WARNING,
        "A volume has an inside; its material should not be double-sided.",
    ),
    "KHR_MATERIALS_VOLUME_NO_TRANSMISSION": (WARNING, "No light enters the volume: nothing here transmits."),
    "MATERIAL_ALPHA_CUTOFF_INVALID_MODE": (WARNING, "Only the alpha mode MASK reads alphaCutoff."),
    "MESH_INVALID_WEIGHTS_COUNT": (ERROR, "{count} weights stand for {targets} morph targets."),
    "MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT": (
        ERROR,
        "All primitives of a mesh have the same number of morph targets.",
    ),
    "MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY": (
        ERROR,
        "The sets of {semantic} must count from 0 without a gap.",
    ),
    "MESH_PRIMITIVE_INVALID_ATTRIBUTE": (
        ERROR,
        "glTF knows no such attribute; one's own names start with '_'.",
    ),
    "MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH": (
        ERROR,
        "{joints} sets of joints stand beside {weights} of weights.",
    ),
    "MESH_PRIMITIVE_NO_POSITION": (WARNING, "Without POSITION nothing is drawn."),
    "MESH_PRIMITIVE_TANGENT_WITHOUT_NORMAL": (WARNING, "Tangents mean nothing without NORMAL."),
    "MULTIPLE_EXTENSIONS": (WARNING, "The extension replaces the shading that its neighbours would change."),
    "NODE_EMPTY": (INFORMATION, "The node does nothing."),
    "NODE_MATRIX_DEFAULT": (INFORMATION, "The matrix is the identity; leave it out."),
    "NODE_MATRIX_NON_TRS": (ERROR, "The matrix is no product of translation, rotation and scale."),
    "NODE_MATRIX_TRS": (ERROR, "A node has a matrix or translation, rotation and scale, not both."),
    "NODE_SKINNED_MESH_LOCAL_TRANSFORMS": (
        WARNING,
        "The node's mesh is skinned: its own transform does not move it.",
    ),
    "NODE_SKINNED_MESH_NON_ROOT": (
        INFORMATION,
        "A skinned mesh does not move with its parents; make it a root.",
    ),
    "NODE_SKINNED_MESH_PARENT_TRANSFORMS": (
        WARNING,
        "The transforms of its parents do not move a skinned mesh.",
    ),
    "NODE_SKIN_NO_SCENE": (ERROR, "The scene that shows the skinned mesh lacks its joints."),
    "NON_OBJECT_EXTRAS": (INFORMATION, "Readers expect an object in 'extras'."),
    "NON_RELATIVE_URI": (WARNING, "The URI {uri} is not relative; readers refuse or fetch it."),
    "NON_REQUIRED_EXTENSION": (ERROR, "The extension {extension!r} must stand in extensionsRequired."),
    "ROTATION_NON_UNIT": (ERROR, "The quaternion is not of length 1."),
    "SKIN_NO_COMMON_ROOT": (ERROR, "The joints have no ancestor in common."),
    "SKIN_SKELETON_INVALID": (ERROR, "The skeleton is not an ancestor of all joints."),
    "UNKNOWN_ASSET_MAJOR_VERSION": (ERROR, "The major version {version} of glTF is not known."),
    "UNKNOWN_ASSET_MINOR_VERSION": (WARNING, "The minor version {version} of glTF is not known."),
    "UNUSED_EXTENSION_REQUIRED": (ERROR, "{extension!r} is required, but not in extensionsUsed."),
}
