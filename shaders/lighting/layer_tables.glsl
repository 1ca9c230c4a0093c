// The colours of Bragg layers out of tables: gltf_iri/baking/baked_layers.py says what they hold.
// Twin: gltf_iri/baking/layer_lookup.py. gltf_iri/rendering/layer_tables.py makes the texture and says where slices lie.
//
// Across lies the cosine in the host, down the period texture's value; OpenGL clamps to the first and last node and mixes
// linearly between nodes. Slices are never mixed. A spectrum is four bands a texel, BRAGG_QUADS texels.

#include "lighting/view.glsl"
#include "material/surface.glsl"

uniform highp sampler2DArray u_bragg_tables;
uniform vec3 u_bragg_cosine;  // first value, scale, place of the first node
uniform vec3 u_bragg_texel;
#ifndef BRAGG_COLOURS
uniform vec3 u_bragg_weights[4 * BRAGG_QUADS];  // of each band, linear Rec.709
#endif

#ifdef BRAGG_METAL_ROUGHNESS
uniform vec3 u_bragg_metal_roughness;  // first value, scale, last node
#endif

// Slices, as `layer_table_slices` of gltf_iri/rendering/layer_tables.py counts them. The first layer's reflection is a
// colour, and so is all that becomes of a white sky.
const int FIRST_SLICE = 0;
const int REFLECTED_SLICE = 1;
const int TRANSMITTED_SLICE = REFLECTED_SLICE + (BRAGG_LAYERS - 1) * BRAGG_QUADS;
#ifdef BRAGG_BASE
const int SENT_SLICE = TRANSMITTED_SLICE + BRAGG_LAYERS * BRAGG_QUADS;
const int SCATTERED_SLICE = SENT_SLICE + BRAGG_LAYERS;
const int MIRRORED_SLICE = SCATTERED_SLICE + 1;
#else
const int SENT_SLICE = TRANSMITTED_SLICE + (BRAGG_LAYERS - 1) * BRAGG_QUADS;
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
// Π T_k of the first `count` layers, crossed once.
vec4 entering_bands(vec2 place, int count, int quad) {
    vec4 bands = vec4(1.0);
    for (int k = 0; k < count; ++k) {
        bands *= table_texel(place, TRANSMITTED_SLICE + k * BRAGG_QUADS + quad);
    }
    return bands;
}

// Π T_k(i) T_k(o) of the first `count` layers.
vec4 passed_bands(vec2 place_i, vec2 place_o, int count, int quad) {
    return entering_bands(place_i, count, quad) * entering_bands(place_o, count, quad);
}
#endif

// R_layer(h) Π T_k(i) T_k(o) over the layers above it.
vec3 layer_reflected(Surface s, int layer, float cos_h, float cos_i, float cos_o) {
    vec2 place = table_place(s, cos_h);
#ifdef BRAGG_MANY
    if (layer > 0) {
        vec2 place_i = table_place(s, cos_i), place_o = table_place(s, cos_o);
        vec3 colour = vec3(0.0);
        for (int quad = 0; quad < BRAGG_QUADS; ++quad) {
            vec4 bands = table_texel(place, REFLECTED_SLICE + (layer - 1) * BRAGG_QUADS + quad);
            colour += colour_of(bands * passed_bands(place_i, place_o, layer, quad), quad);
        }
        return colour;
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

#ifdef HAS_TRANSMISSION
// Π T_k(o) over all layers.
vec3 layers_entering(Surface s, float cos_o) {
    vec2 place = table_place(s, cos_o);
    vec3 colour = vec3(0.0);
    for (int quad = 0; quad < BRAGG_QUADS; ++quad) {
        colour += colour_of(entering_bands(place, BRAGG_LAYERS, quad), quad);
    }
    return colour;
}
#endif
#endif

#ifdef HAS_IMAGE_LIGHT
// What `layer` sends of a white sky.
vec3 layer_albedo(Surface s, View w, int layer) {
    return table_texel(table_place(s, cosine_at_layers(w)), SENT_SLICE + layer).rgb;
}

#ifdef BRAGG_BASE
// What a white Lambertian base, as if it lay in the host, sends of a white sky.
vec3 scattered_albedo(Surface s, View w) {
    return table_texel(table_place(s, cosine_at_layers(w)), SCATTERED_SLICE).rgb;
}

#ifdef HAS_METAL
// What a metal of reflectance F0 = base colour sends of a white sky.
vec3 metal_albedo(Surface s, View w) {
    vec2 place = table_place(s, cosine_at_layers(w));
#ifdef BRAGG_METAL_ROUGHNESS
    vec3 axis = u_bragg_metal_roughness;
    float node = clamp((s.perceptual_roughness - axis.x) * axis.y, 0.0, axis.z);
    float first = min(floor(node), axis.z - 1.0), on = node - first;
    int here = MIRRORED_SLICE + 2 * int(first);
    vec3 slope = mix(table_texel(place, here).rgb, table_texel(place, here + 2).rgb, on);
    vec3 offset = mix(table_texel(place, here + 1).rgb, table_texel(place, here + 3).rgb, on);
#else
    vec3 slope = table_texel(place, MIRRORED_SLICE).rgb, offset = table_texel(place, MIRRORED_SLICE + 1).rgb;
#endif
    return s.base_color * slope + offset;
}
#endif
#endif
#endif
