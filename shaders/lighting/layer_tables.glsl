// The colours of Bragg layers out of tables: gltf_iri/baking/baked_layers.py says what they hold.
// Twin: gltf_iri/baking/layer_lookup.py. gltf_iri/rendering/layer_tables.py makes the texture and says where slices lie.
//
// Across lies the cosine in the host, down the period texture's value; OpenGL clamps to the first and last node and mixes
// linearly between nodes. Slices are never mixed. A spectrum is four bands a texel, BRAGG_QUADS texels.

#include "material/surface.glsl"

uniform highp sampler2DArray u_bragg_tables;
uniform vec3 u_bragg_cosine;  // first value, scale, place of the first node
uniform vec3 u_bragg_texel;
#ifndef BRAGG_COLOURS
uniform vec3 u_bragg_weights[4 * BRAGG_QUADS];  // of each band, linear Rec.709
#endif

// Slices, as `layer_table_slices` of gltf_iri/rendering/layer_tables.py counts them. The first layer's reflection is a colour.
const int FIRST_SLICE = 0;
const int FIRST_ALBEDO_SLICE = 1;
const int REFLECTED_SLICE = 2;
const int ALBEDO_SLICE = REFLECTED_SLICE + (BRAGG_LAYERS - 1) * BRAGG_QUADS;
const int TRANSMITTED_SLICE = ALBEDO_SLICE + (BRAGG_LAYERS - 1) * BRAGG_QUADS;
#ifdef BRAGG_BASE
const int IRRADIANCE_SLICE = TRANSMITTED_SLICE + BRAGG_LAYERS * BRAGG_QUADS;
#endif

vec2 table_place(Surface s, float cos_theta) {
    vec2 at = vec2(cos_theta, s.bragg_period_texel);
    vec2 low = vec2(u_bragg_cosine.x, u_bragg_texel.x), scale = vec2(u_bragg_cosine.y, u_bragg_texel.y);
    return (at - low) * scale + vec2(u_bragg_cosine.z, u_bragg_texel.z);
}

// No implicit level of detail: it wants derivatives, and lights are met in loops.
vec4 table_texel(vec2 place, int slice) { return textureLod(u_bragg_tables, vec3(place, float(slice)), 0.0); }

// What four bands add to a colour.
vec3 colour_of(vec4 bands, int quad) {
#ifdef BRAGG_COLOURS
    return bands.rgb;
#else
    return bands.x * u_bragg_weights[4 * quad] + bands.y * u_bragg_weights[4 * quad + 1] +
           bands.z * u_bragg_weights[4 * quad + 2] + bands.w * u_bragg_weights[4 * quad + 3];
#endif
}

#if defined(BRAGG_BASE) || defined(BRAGG_MANY)
// Π T_k(i) T_k(o) of the first `count` layers.
vec4 passed_bands(vec2 place_i, vec2 place_o, int count, int quad) {
    vec4 bands = vec4(1.0);
    for (int k = 0; k < count; ++k) {
        int slice = TRANSMITTED_SLICE + k * BRAGG_QUADS + quad;
        bands *= table_texel(place_i, slice) * table_texel(place_o, slice);
    }
    return bands;
}
#endif

#ifdef BRAGG_MANY
// The colour of a factor of `layer` behind those above it; its spectrum begins at `first_slice` + (layer − 1)·quads.
vec3 behind_layers(vec2 place, vec2 place_i, vec2 place_o, int layer, int first_slice) {
    vec3 colour = vec3(0.0);
    for (int quad = 0; quad < BRAGG_QUADS; ++quad) {
        vec4 bands = table_texel(place, first_slice + (layer - 1) * BRAGG_QUADS + quad);
        colour += colour_of(bands * passed_bands(place_i, place_o, layer, quad), quad);
    }
    return colour;
}
#endif

// R_layer(h) Π T_k(i) T_k(o) over the layers above it.
vec3 layer_reflected(Surface s, int layer, float cos_h, float cos_i, float cos_o) {
    vec2 place = table_place(s, cos_h);
#ifdef BRAGG_MANY
    if (layer > 0) {
        return behind_layers(place, table_place(s, cos_i), table_place(s, cos_o), layer, REFLECTED_SLICE);
    }
#endif
    return table_texel(place, FIRST_SLICE).rgb;
}

#ifdef BRAGG_BASE
// Π T_k(i) T_k(o) over all layers.
vec3 layers_passed(Surface s, float cos_i, float cos_o) {
    vec2 place_i = table_place(s, cos_i), place_o = table_place(s, cos_o);
    vec3 colour = vec3(0.0);
    for (int quad = 0; quad < BRAGG_QUADS; ++quad) {
        colour += colour_of(passed_bands(place_i, place_o, BRAGG_LAYERS, quad), quad);
    }
    return colour;
}
#endif

#ifdef HAS_IMAGE_LIGHT
// What `layer` sends of a white sky to a viewer at `cos_o`.
vec3 layer_albedo(Surface s, int layer, float cos_o) {
    vec2 place = table_place(s, cos_o);
#ifdef BRAGG_MANY
    if (layer > 0) {
        return behind_layers(place, place, place, layer, ALBEDO_SLICE);
    }
#endif
    return table_texel(place, FIRST_ALBEDO_SLICE).rgb;
}

#ifdef BRAGG_BASE
// What of a white sky passes all layers, and them again towards a viewer at `cos_o`: each layer's mean by itself.
vec3 layers_passed_irradiance(Surface s, float cos_o) {
    vec2 place = table_place(s, cos_o);
    vec3 colour = vec3(0.0);
    for (int quad = 0; quad < BRAGG_QUADS; ++quad) {
        vec4 bands = vec4(1.0);
        for (int k = 0; k < BRAGG_LAYERS; ++k) {
            int slice = k * BRAGG_QUADS + quad;
            bands *= table_texel(place, TRANSMITTED_SLICE + slice) * table_texel(place, IRRADIANCE_SLICE + slice);
        }
        colour += colour_of(bands, quad);
    }
    return colour;
}
#endif
#endif
