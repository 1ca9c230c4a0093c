"""What a shader is told about a material: the same rows as GLSL declarations and as values for them.

`interface_glsl` writes shaders/generated/material.glsl; `material_uniforms` and `material_textures` fill it.
Each declaration stands behind the define of the effect that needs it, so a permutation without the effect
has neither the uniform nor the code. Pure data: no OpenGL here.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.bragg import Bragg
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.dispersion import Dispersion
from gltf_iri.material.emissive_strength import EmissiveStrength
from gltf_iri.material.fields import ColourSpace, Kind, Property, properties
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import TextureInfo
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume

__all__ = ["SAMPLERS", "UNIFORMS", "Sampler", "TextureBinding", "Uniform"]
__all__ += ["interface_glsl", "material_textures", "material_uniforms"]

Value = int | float | tuple[float, ...]

# Where the shader's rows stand: attribute of Material ("" itself), prefix of the names, dataclass, guard.
_PARTS: tuple[tuple[str, str, type, str], ...] = (
    ("pbr", "", MetallicRoughness, "!HAS_UNLIT"),
    ("", "", Material, ""),
    ("specular", "specular_", Specular, "HAS_SPECULAR"),
    ("iridescence", "iridescence_", Iridescence, "HAS_IRIDESCENCE"),
    ("bragg", "bragg_", Bragg, "HAS_BRAGG"),
    ("anisotropy", "anisotropy_", Anisotropy, "HAS_ANISOTROPY"),
    ("transmission", "transmission_", Transmission, "HAS_TRANSMISSION"),
    ("volume", "volume_", Volume, "HAS_VOLUME"),
    ("dispersion", "", Dispersion, "HAS_DISPERSION"),
    ("sheen", "sheen_", Sheen, "HAS_SHEEN"),
    ("clearcoat", "clearcoat_", Clearcoat, "HAS_CLEARCOAT"),
)

# Rows that reach the shader only in what is computed from them.
_NOT_SENT: frozenset[str] = frozenset({"volume_attenuation_distance_m", "volume_attenuation_color"})

# Factors whose guard is not their part's. An unlit material still has its base colour.
_OWN_GUARD: Mapping[str, str] = {
    "base_color_factor": "",
    "alpha_cutoff": "HAS_ALPHA_MASK",
    "emissive_factor": "HAS_EMISSION",
}

# Textures of which the shader reads moments under a define; E[t] lies where t would.
_MOMENTS_UNDER: Mapping[str, str] = {"iridescence_thickness": "HAS_IRIDESCENCE_THICKNESS_SPREAD"}

# Number of components to type.
_GLSL_TYPES: Mapping[int, str] = {1: "float", 2: "vec2", 3: "vec3", 4: "vec4"}


@dataclass(frozen=True, slots=True)
class Uniform:
    """One uniform: declared behind `guard` ("" always, "!X" unless X), filled by `read`."""

    name: str
    glsl_type: str
    guard: str
    about: str
    read: Callable[[Material], Value]


@dataclass(frozen=True, slots=True)
class Sampler:
    """One texture with its transform and UV set, and the function that samples it."""

    slot: str  # base_color, iridescence_thickness, …
    guard: str
    row: Property
    read: Callable[[Material], TextureInfo | None]

    @property
    def name(self) -> str:
        """Name of the sampler2D."""
        return f"u_{self.slot}_texture"


@dataclass(frozen=True, slots=True)
class TextureBinding:
    """What to bind to a sampler: an index into glTF's textures, decoded from this colour space.

    moments_of : the channel, one of "rgba", of which the shader reads E[t²] in R and E[t] in G, averaged over
        what a pixel spans; "" for the texels themselves.
    """

    texture: int
    colour_space: ColourSpace
    moments_of: str = ""


def _reader(part: str, attribute: str, cls: type) -> Callable[[Material], Any]:
    """Return what reads ``material.part.attribute``, or the default where the part is absent."""

    def read(material: Material) -> Any:
        holder = getattr(material, part) if part else material
        return getattr(cls() if holder is None else holder, attribute)

    return read


def _emitted(material: Material) -> tuple[float, ...]:
    strength = (material.emissive_strength or EmissiveStrength()).strength
    return tuple(strength * channel for channel in material.emissive_factor)


# Values that are computed from more than one row.
_COMBINED: Mapping[str, Callable[[Material], Value]] = {"emissive_factor": _emitted}
_ABOUT_COMBINED: Mapping[str, str] = {"emissive_factor": "Emitted light, emissive strength included."}


def _uniforms() -> Iterator[Uniform]:
    for part, prefix, cls, part_guard in _PARTS:
        for attribute, row in properties(cls):
            name = prefix + attribute
            if row.kind is Kind.TEXTURE:
                yield from _texture_uniforms(_slot(name), row, _reader(part, attribute, cls))
            elif row.kind in (Kind.NUMBER, Kind.VECTOR) and name not in _NOT_SENT:
                read = _COMBINED.get(name, _reader(part, attribute, cls))
                about = _ABOUT_COMBINED.get(name, row.about)
                yield Uniform(f"u_{name}", _glsl_type(row), _OWN_GUARD.get(name, part_guard), about, read)
    about = "Reflectance of the base at normal incidence under air, from its refractive index."
    yield Uniform("u_dielectric_f0", "float", "HAS_DIELECTRIC", about, lambda m: (m.ior or Ior()).f0)
    about = "Refractive index of the inside."
    yield Uniform("u_volume_ior", "float", "HAS_VOLUME", about, lambda m: (m.ior or Ior()).ior)
    about = "Absorption: light keeps exp(−absorption · path)."
    yield Uniform(
        "u_volume_absorption_per_m",
        "vec3",
        "HAS_VOLUME",
        about,
        lambda m: (m.volume or Volume()).absorption_per_m,
    )


def _texture_uniforms(
    slot: str, row: Property, read: Callable[[Material], TextureInfo | None]
) -> Iterator[Uniform]:
    """Yield the numbers that a textureInfo adds to its own, such as normal scale and occlusion strength."""
    if row.cls is None:
        return
    for attribute, extra in properties(row.cls):
        if extra.kind is Kind.NUMBER:

            def value(material: Material, attribute: str = attribute, default: Any = extra.default) -> Value:
                info = read(material)
                number: float = default if info is None else getattr(info, attribute)
                return number

            yield Uniform(f"u_{slot}_{attribute}", "float", _texture_guard(slot), extra.about, value)


def _samplers() -> Iterator[Sampler]:
    for part, prefix, cls, _ in _PARTS:
        for attribute, row in properties(cls):
            if row.kind is Kind.TEXTURE:
                slot = _slot(prefix + attribute)
                yield Sampler(slot, _texture_guard(slot), row, _reader(part, attribute, cls))


def _slot(name: str) -> str:
    return name.removesuffix("_texture")


def _texture_guard(slot: str) -> str:
    return f"HAS_{slot.upper()}_TEXTURE"


def _glsl_type(row: Property) -> str:
    return _GLSL_TYPES[row.length]


UNIFORMS: tuple[Uniform, ...] = tuple(_uniforms())
SAMPLERS: tuple[Sampler, ...] = tuple(_samplers())


def _is_on(guard: str, defines: Collection[str]) -> bool:
    if guard.startswith("!"):
        return guard[1:] not in defines
    return not guard or guard in defines


def material_uniforms(material: Material, defines: Collection[str]) -> dict[str, Value]:
    """Return the value of every material uniform that a shader with these `defines` declares.

    Numbers are floats or ints, vectors tuples, ``u_<slot>_uv_transform`` nine floats column by column.
    """
    values = {u.name: u.read(material) for u in UNIFORMS if _is_on(u.guard, defines)}
    for sampler in SAMPLERS:
        info = sampler.read(material) if _is_on(sampler.guard, defines) else None
        if info is not None:
            rows = info.uv_matrix
            values[f"u_{sampler.slot}_uv_transform"] = tuple(row[i] for i in range(3) for row in rows)
            values[f"u_{sampler.slot}_uv_set"] = info.uv_set
    return values


def material_textures(material: Material, defines: Collection[str]) -> dict[str, TextureBinding]:
    """Return what to bind to each sampler that a shader with these `defines` declares."""
    bindings = {}
    for sampler in SAMPLERS:
        info = sampler.read(material) if _is_on(sampler.guard, defines) else None
        if info is not None:
            is_spread = _MOMENTS_UNDER.get(sampler.slot) in defines
            moments_of = sampler.row.channels if is_spread else ""
            bindings[sampler.name] = TextureBinding(info.texture, sampler.row.colour_space, moments_of)
    return bindings


def interface_glsl() -> str:
    """Return the GLSL that declares every uniform and sampler and the functions that sample."""
    blocks = ["// The material, as gltf_iri/material/ states it. Written by gltf_iri.generate; do not edit."]
    for guard in dict.fromkeys(u.guard for u in UNIFORMS if not u.guard.endswith("_TEXTURE")):
        lines = [_declaration(u) for u in UNIFORMS if u.guard == guard]
        blocks.append(_guarded(guard, lines))
    for sampler in SAMPLERS:
        own = [_declaration(u) for u in UNIFORMS if u.guard == sampler.guard]
        blocks.append(_guarded(sampler.guard, [*own, *_sampler_lines(sampler)]))
    return "\n\n".join(blocks) + "\n"


def _guarded(guard: str, lines: list[str]) -> str:
    if not guard:
        return "\n".join(lines)
    opening = f"#ifndef {guard[1:]}" if guard.startswith("!") else f"#ifdef {guard}"
    return "\n".join([opening, *lines, "#endif"])


def _declaration(uniform: Uniform) -> str:
    return f"// {uniform.about}\nuniform {uniform.glsl_type} {uniform.name};"


def _sampler_lines(sampler: Sampler) -> list[str]:
    slot, row = sampler.slot, sampler.row
    stored = "as sRGB, sampled as linear" if row.colour_space == "srgb" else "linear"
    sampled = _GLSL_TYPES[len(row.channels)]
    return [
        f"// {row.about} Reads {row.channels.upper()}, stored {stored}.",
        f"uniform sampler2D {sampler.name};",
        f"uniform mat3 u_{slot}_uv_transform;",
        f"uniform int u_{slot}_uv_set;",
        f"vec2 {slot}_uv(vec2 uv0, vec2 uv1) {{",
        f"    return (u_{slot}_uv_transform * vec3(u_{slot}_uv_set == 0 ? uv0 : uv1, 1.0)).xy;",
        "}",
        f"{sampled} sample_{slot}(vec2 uv0, vec2 uv1) {{",
        f"    return texture({sampler.name}, {slot}_uv(uv0, uv1)).{row.channels};",
        "}",
    ]
