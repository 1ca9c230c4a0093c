// The film's colour out of tables: gltf_iri/planning/film_table.py says what they hold, and along which axes.
// Twin: gltf_iri/baking/lookup.py. gltf_iri/rendering/film_tables.py makes the textures, and the numbers of each axis.
//
// One or two axes lie in a 2D texture, three in a 3D one; of four, the last counts slabs of the third, one behind the
// other. OpenGL clamps to the first and last node and mixes linearly between nodes. No implicit level of detail: it
// wants derivatives, and lights are met in loops.

#include "lighting/lobe.glsl"
#include "material/surface.glsl"

// Where a value lies along an axis of (first value, scale, place of the first node).
float axis_place(vec3 axis, float value) { return (value - axis.x) * axis.y + axis.z; }

vec3 table_colour(sampler2D table, vec4 place) { return textureLod(table, place.xy, 0.0).rgb; }

vec3 table_colour(sampler3D table, vec4 place) { return textureLod(table, place.xyz, 0.0).rgb; }

// Here the third and the fourth place count nodes; slabs are mixed, for OpenGL would mix neighbours within a slab.
vec3 table_colour(sampler3D table, vec2 nodes, vec4 place) {
    vec2 at = clamp(place.zw, vec2(0.0), nodes - 1.0);
    float slab = min(floor(at.y), max(nodes.y - 2.0, 0.0));
    float depth = (slab * nodes.x + at.x + 0.5) / (nodes.x * nodes.y);
    vec3 before = textureLod(table, vec3(place.xy, depth), 0.0).rgb;
    vec3 after = textureLod(table, vec3(place.xy, depth + 1.0 / nodes.y), 0.0).rgb;
    return mix(before, after, at.y - slab);
}

#ifdef DIELECTRIC_TABLE
#ifdef DIELECTRIC_TABLE_3D
uniform highp sampler3D u_dielectric_table;
#else
uniform highp sampler2D u_dielectric_table;
#endif
uniform vec3 u_dielectric_table_cos_theta;
uniform vec3 u_dielectric_table_thickness;
uniform vec3 u_dielectric_table_base;
uniform vec3 u_dielectric_table_roughness;
uniform vec3 u_dielectric_table_spread;
uniform vec2 u_dielectric_table_nodes;  // along the third and the fourth axis

vec3 dielectric_table(Surface s, float base_f0, Lobe lobe) {
    vec4 place = vec4(0.0);  // filled from the last axis to the first
#ifdef DIELECTRIC_TABLE_SPREAD
    place = vec4(axis_place(u_dielectric_table_spread, s.iridescence_thickness_std_nm), place.xyz);
#endif
#ifdef DIELECTRIC_TABLE_ROUGHNESS
    place = vec4(axis_place(u_dielectric_table_roughness, lobe.roughness), place.xyz);
    float cos_theta = lobe.cos_theta;
#else
    float cos_theta = lobe.facet_cosine;
#endif
#ifdef DIELECTRIC_TABLE_BASE
    place = vec4(axis_place(u_dielectric_table_base, sqrt(base_f0)), place.xyz);
#endif
#ifdef DIELECTRIC_TABLE_THICKNESS
    place = vec4(axis_place(u_dielectric_table_thickness, s.iridescence_thickness_nm), place.xyz);
#endif
    place = vec4(axis_place(u_dielectric_table_cos_theta, cos_theta), place.xyz);
#ifdef DIELECTRIC_TABLE_4D
    return table_colour(u_dielectric_table, u_dielectric_table_nodes, place);
#else
    return table_colour(u_dielectric_table, place);
#endif
}

// Entries over a grey base of that reflectance: each channel of another base has its own.
vec3 dielectric_table(Surface s, vec3 base_f0, Lobe lobe) {
    vec3 colour = dielectric_table(s, base_f0.r, lobe);
#if defined(DIELECTRIC_TABLE_BASE) && !defined(GREY_DIELECTRIC)
    if (base_f0.g != base_f0.r || base_f0.b != base_f0.r) {
        colour.g = dielectric_table(s, base_f0.g, lobe).g;
        colour.b = dielectric_table(s, base_f0.b, lobe).b;
    }
#endif
    return colour;
}
#endif

#ifdef METAL_TABLE
#ifdef METAL_TABLE_3D
uniform highp sampler3D u_metal_table;
#else
uniform highp sampler2D u_metal_table;
#endif
uniform vec3 u_metal_table_cos_theta;
uniform vec3 u_metal_table_thickness;
uniform vec3 u_metal_table_base;
uniform vec3 u_metal_table_roughness;
uniform vec3 u_metal_table_spread;
uniform vec2 u_metal_table_nodes;  // along the third and the fourth axis

vec3 metal_table(Surface s, float base_f0, Lobe lobe) {
    vec4 place = vec4(0.0);  // filled from the last axis to the first
#ifdef METAL_TABLE_SPREAD
    place = vec4(axis_place(u_metal_table_spread, s.iridescence_thickness_std_nm), place.xyz);
#endif
#ifdef METAL_TABLE_ROUGHNESS
    place = vec4(axis_place(u_metal_table_roughness, lobe.roughness), place.xyz);
    float cos_theta = lobe.cos_theta;
#else
    float cos_theta = lobe.facet_cosine;
#endif
#ifdef METAL_TABLE_BASE
    place = vec4(axis_place(u_metal_table_base, sqrt(base_f0)), place.xyz);
#endif
#ifdef METAL_TABLE_THICKNESS
    place = vec4(axis_place(u_metal_table_thickness, s.iridescence_thickness_nm), place.xyz);
#endif
    place = vec4(axis_place(u_metal_table_cos_theta, cos_theta), place.xyz);
#ifdef METAL_TABLE_4D
    return table_colour(u_metal_table, u_metal_table_nodes, place);
#else
    return table_colour(u_metal_table, place);
#endif
}

// Entries over a grey base of that reflectance: each channel of another base has its own.
vec3 metal_table(Surface s, vec3 base_f0, Lobe lobe) {
    vec3 colour = metal_table(s, base_f0.r, lobe);
#if defined(METAL_TABLE_BASE) && !defined(GREY_METAL)
    if (base_f0.g != base_f0.r || base_f0.b != base_f0.r) {
        colour.g = metal_table(s, base_f0.g, lobe).g;
        colour.b = metal_table(s, base_f0.b, lobe).b;
    }
#endif
    return colour;
}
#endif
