"""The Khronos codes of links, data and container: severity and our sentence."""

from __future__ import annotations

from gltf_iri.validation.issue import ERROR, HINT, INFORMATION, WARNING

__all__ = ["CODES_OF_LINKS"]

CODES_OF_LINKS: dict[str, tuple[int, str]] = {
    # Between objects
    "ACCESSOR_SMALL_BYTESTRIDE": (
        ERROR,
        "The buffer view's byteStride {stride} is less than the element's {size} bytes.",
    ),
    "ACCESSOR_TOO_LONG": (
        ERROR,
        "From offset {start} on, {length} bytes do not fit buffer view {view} of {available}.",
    ),
    "ACCESSOR_TOTAL_OFFSET_ALIGNMENT": (
        ERROR,
        "The offset in the buffer, {start}, is not a multiple of the component's {size} bytes.",
    ),
    "ACCESSOR_USAGE_OVERRIDE": (ERROR, "The accessor serves as {initial} already and cannot serve as {new}."),
    "ANIMATION_CHANNEL_TARGET_NODE_MATRIX": (
        ERROR,
        "The node has a matrix; translation, rotation and scale cannot move it.",
    ),
    "ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS": (
        ERROR,
        "The node's mesh has no morph targets to weight.",
    ),
    "ANIMATION_DUPLICATE_TARGETS": (ERROR, "Channel {channel} moves the same property."),
    "ANIMATION_SAMPLER_ACCESSOR_WITH_BYTESTRIDE": (ERROR, "Keyframes lie without gaps: no byteStride."),
    "ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT": (ERROR, "Times are {allowed}, not {format}."),
    "ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS": (
        ERROR,
        "The interpolation {interpolation} wants {minimum} keyframes or more, not {count}.",
    ),
    "ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS": (
        ERROR,
        "The accessor of times must have min and max.",
    ),
    "ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT": (
        ERROR,
        "{wanted} elements belong to the times, not {count}.",
    ),
    "ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT": (
        ERROR,
        "The path {path} takes {allowed}, not {format}.",
    ),
    "BUFFER_MISSING_GLB_DATA": (ERROR, "The buffer has no URI, and the GLB has no BIN chunk for it."),
    "BUFFER_VIEW_TARGET_MISSING": (
        HINT,
        "The buffer view holds vertices or indices; its target should say so.",
    ),
    "BUFFER_VIEW_TARGET_OVERRIDE": (
        ERROR,
        "The buffer view serves as {initial} already and cannot serve as {new}.",
    ),
    "BUFFER_VIEW_TOO_LONG": (ERROR, "It does not fit buffer {buffer} of {length} bytes."),
    "IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE": (ERROR, "A picture's bytes follow each other: no byteStride."),
    "INCOMPLETE_EXTENSION_SUPPORT": (INFORMATION, "The extension is not checked whole; faults may remain."),
    "INVALID_IBM_ACCESSOR_COUNT": (ERROR, "{count} inverse bind matrices stand for {joints} joints."),
    "KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT": (
        ERROR,
        "The variant has a material on this primitive already.",
    ),
    "MESH_PRIMITIVE_ACCESSOR_UNALIGNED": (ERROR, "Vertex attributes must start on multiples of 4 bytes."),
    "MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE": (
        ERROR,
        "Two or more attributes share the buffer view; it must have a byteStride.",
    ),
    "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT": (
        ERROR,
        "The attribute takes {allowed}, not {format}.",
    ),
    "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT": (ERROR, "Attributes cannot have 32-bit integers."),
    "MESH_PRIMITIVE_GENERATED_TANGENT_SPACE": (
        WARNING,
        "The material wants tangents; made at run time, they differ between renderers.",
    ),
    "MESH_PRIMITIVE_INCOMPATIBLE_MODE": (WARNING, "{count} vertices or indices do not make whole {mode}."),
    "MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT": (ERROR, "Indices are {allowed}, not {format}."),
    "MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE": (ERROR, "Indices lie without gaps: no byteStride."),
    "MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT": (
        ERROR,
        "The attribute that it moves has another count.",
    ),
    "MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR": (ERROR, "The primitive has no such attribute to move."),
    "MESH_PRIMITIVE_NO_TANGENT_SPACE": (
        ERROR,
        "The material wants tangents, and no normal texture says how to make them.",
    ),
    "MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS": (
        ERROR,
        "The accessor of POSITION must have min and max.",
    ),
    "MESH_PRIMITIVE_TOO_FEW_TEXCOORDS": (
        ERROR,
        "The material's texture {texture} reads TEXCOORD_{set}, which is missing.",
    ),
    "MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT": (ERROR, "All attributes of a primitive have the same count."),
    "NODE_LOOP": (ERROR, "The node is its own ancestor."),
    "NODE_PARENT_OVERRIDE": (ERROR, "Node {node} has a parent already."),
    "NODE_SKINNED_MESH_WITHOUT_SKIN": (WARNING, "The mesh has joints, but the node no skin."),
    "NODE_SKIN_WITH_NON_SKINNED_MESH": (ERROR, "The node has a skin, but its mesh no joints."),
    "NODE_WEIGHTS_INVALID": (ERROR, "{count} weights stand for {targets} morph targets."),
    "SCENE_NON_ROOT_NODE": (ERROR, "Node {node} has a parent; a scene lists roots only."),
    "SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE": (ERROR, "Inverse bind matrices lie without gaps: no byteStride."),
    "SKIN_IBM_INVALID_FORMAT": (ERROR, "Inverse bind matrices are {allowed}, not {format}."),
    "TEXTURE_INVALID_IMAGE_MIME_TYPE": (ERROR, "The image is {media_type}; here it must be {allowed}."),
    "UNDECLARED_EXTENSION": (ERROR, "The extension does not stand in extensionsUsed."),
    "UNEXPECTED_EXTENSION_OBJECT": (ERROR, "The extension does not belong on this object."),
    "UNRESOLVED_REFERENCE": (ERROR, "The index {index} refers to nothing."),
    "UNSUPPORTED_EXTENSION": (
        INFORMATION,
        "The extension {extension} is not known here; its objects are not checked.",
    ),
    "UNUSED_MESH_TANGENT": (INFORMATION, "The material has no texture that reads the tangents."),
    "UNUSED_MESH_WEIGHTS": (INFORMATION, "Every node that shows the mesh has weights of its own."),
    "UNUSED_OBJECT": (INFORMATION, "Nothing refers to it."),
    # The data
    "ACCESSOR_ANIMATION_INPUT_NEGATIVE": (ERROR, "The time at {index} is negative: {value}."),
    "ACCESSOR_ANIMATION_INPUT_NON_INCREASING": (
        ERROR,
        "The time at {index} is not after the one before: {value} ≤ {previous}.",
    ),
    "ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION": (
        ERROR,
        "The quaternion at {first}..{last} has the length {length}.",
    ),
    "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND": (ERROR, "{count} elements are greater than the maximum {bound}."),
    "ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND": (ERROR, "{count} elements are less than the minimum {bound}."),
    "ACCESSOR_INDEX_OOB": (ERROR, "The index at {index} is {value}; the last vertex is {last}."),
    "ACCESSOR_INDEX_PRIMITIVE_RESTART": (
        ERROR,
        "The index at {index} is {value}, which would start a new primitive.",
    ),
    "ACCESSOR_INDEX_TRIANGLE_DEGENERATE": (INFORMATION, "{count} of {total} triangles name a vertex twice."),
    "ACCESSOR_INVALID_FLOAT": (ERROR, "The component at {index} is {value}."),
    "ACCESSOR_INVALID_IBM": (ERROR, "The matrix at {index} has {value} as component {component}."),
    "ACCESSOR_INVALID_SIGN": (ERROR, "The tangent at {first}..{last} has w = {value}; it must be 1 or -1."),
    "ACCESSOR_JOINTS_INDEX_DUPLICATE": (
        ERROR,
        "The joint at {index} (component {component}) is {value}, as one before it.",
    ),
    "ACCESSOR_JOINTS_INDEX_OOB": (
        ERROR,
        "The joint at {index} (component {component}) is {value}; the last of skin {skin} is {last}.",
    ),
    "ACCESSOR_JOINTS_USED_ZERO_WEIGHT": (
        WARNING,
        "The joint at {index} (component {component}) is {value}, but has no weight; write 0.",
    ),
    "ACCESSOR_MAX_MISMATCH": (ERROR, "The maximum is {declared}, but the data's is {actual}."),
    "ACCESSOR_MIN_MISMATCH": (ERROR, "The minimum is {declared}, but the data's is {actual}."),
    "ACCESSOR_NON_CLAMPED": (ERROR, "The component at {index} is {value}, outside [0, 1]."),
    "ACCESSOR_SPARSE_INDEX_OOB": (ERROR, "The sparse index at {index} is {value} for {count} elements."),
    "ACCESSOR_SPARSE_INDICES_NON_INCREASING": (
        ERROR,
        "The sparse index at {index} is not greater than the one before: {value} ≤ {previous}.",
    ),
    "ACCESSOR_VECTOR3_NON_UNIT": (ERROR, "The vector at {first}..{last} has the length {length}."),
    "ACCESSOR_WEIGHTS_NEGATIVE": (ERROR, "The weight at {index} (component {component}) is {value}."),
    "ACCESSOR_WEIGHTS_NON_NORMALIZED": (ERROR, "The weights at {first}..{last} add up to {sum}, not 1."),
    "BUFFER_BYTE_LENGTH_MISMATCH": (
        ERROR,
        "The data has {length} bytes, fewer than the byteLength {declared}.",
    ),
    "BUFFER_GLB_CHUNK_TOO_BIG": (WARNING, "The BIN chunk has {extra} bytes more than padding calls for."),
    "DATA_URI_GLB": (WARNING, "A GLB should carry its data in the BIN chunk, not in a data URI."),
    "IMAGE_DATA_INVALID": (ERROR, "The picture is broken: {reason}."),
    "IMAGE_FEATURES_UNSUPPORTED": (
        WARNING,
        "The picture has colour information, oblong pixels or frames that glTF ignores.",
    ),
    "IMAGE_MIME_TYPE_INVALID": (ERROR, "The picture is {found}, but declared as {declared}."),
    "IMAGE_NON_ENABLED_MIME_TYPE": (ERROR, "Only an extension allows {media_type}."),
    "IMAGE_NPOT_DIMENSIONS": (INFORMATION, "{width} × {height} pixels are not powers of two."),
    "IMAGE_UNEXPECTED_EOS": (ERROR, "The picture is cut off."),
    "IMAGE_UNRECOGNIZED_FORMAT": (WARNING, "The bytes are none of the known picture formats."),
    "URI_GLB": (INFORMATION, "The GLB depends on another file."),
    # The binary container
    "GLB_CHUNK_LENGTH_UNALIGNED": (ERROR, "The length of chunk {chunk} is not a multiple of 4."),
    "GLB_CHUNK_TOO_BIG": (ERROR, "Chunk {chunk} claims {length} bytes, more than the GLB has."),
    "GLB_DUPLICATE_CHUNK": (ERROR, "A second chunk {chunk} follows."),
    "GLB_EMPTY_BIN_CHUNK": (INFORMATION, "The BIN chunk is empty; leave it out."),
    "GLB_EMPTY_CHUNK": (ERROR, "Chunk {chunk} must not be empty."),
    "GLB_EXTRA_DATA": (WARNING, "Bytes follow the end of the GLB."),
    "GLB_INVALID_MAGIC": (ERROR, "A GLB starts with 'glTF', not {magic}."),
    "GLB_INVALID_VERSION": (ERROR, "GLB has version 2, not {version}."),
    "GLB_LENGTH_MISMATCH": (ERROR, "The header says {declared} bytes, the file has {length}."),
    "GLB_LENGTH_TOO_SMALL": (ERROR, "The header says {declared} bytes, too few for a GLB."),
    "GLB_UNEXPECTED_BIN_CHUNK": (ERROR, "The BIN chunk must be the second."),
    "GLB_UNEXPECTED_END_OF_CHUNK_DATA": (ERROR, "The file ends inside a chunk."),
    "GLB_UNEXPECTED_END_OF_CHUNK_HEADER": (ERROR, "The file ends inside a chunk's header."),
    "GLB_UNEXPECTED_END_OF_HEADER": (ERROR, "The file ends inside the header."),
    "GLB_UNEXPECTED_FIRST_CHUNK": (ERROR, "The first chunk must be 'JSON', not {chunk}."),
    "GLB_UNKNOWN_CHUNK_TYPE": (WARNING, "glTF knows no chunk {chunk}."),
}
