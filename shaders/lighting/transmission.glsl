// Light that reaches a transmissive surface from behind: first what was drawn farther away, else what lies behind the
// scene. Included after the varyings and u_eye of shaders/pass/surface.frag.
// Sources: KHR_materials_transmission, KHR_materials_volume, KHR_materials_dispersion.

#include "common/math.glsl"
#include "generated/constants.glsl"
#include "lighting/footprint.glsl"
#include "material/surface.glsl"
#include "optics/transmission.glsl"
#ifdef HAS_IMAGE_LIGHT
#include "lighting/environment.glsl"
#endif

// Made by gltf_iri/rendering/capture.py.
uniform sampler2D u_captured;        // premultiplied light, and how much of a pixel is covered
uniform sampler2D u_captured_depth;  // along the view's axis, in metres: depth · known, known
uniform mat4 u_view_projection;
uniform vec4 u_view_axis;       // (forward, offset): depth along the view's axis = dot with (position, 1)
uniform float u_pixel_scale;    // pixels to a metre at a depth of 1 m, for parallel rays at every depth
uniform vec4 u_backdrop;        // colour behind the scene; w = 0: the environment
uniform float u_background_blur;  // perceptual roughness with which the background shows the environment
uniform mat3 u_world_to_mesh;

const int LOBE_TAPS = 16;
const float TAP_OVERLAP = 2.0;  // each averages over more than its share, so that no tap shows as an image of its own
const float TAP_TURN = 2.39996323;  // the golden angle: a sunflower, without gaps at any number of taps
const float COARSE_LEVEL = 5.0;

float view_depth(vec3 position) { return dot(u_view_axis, vec4(position, 1.0)); }

float pixels_per_m(float depth_m) { return u_eye.w > 0.0 ? u_pixel_scale / depth_m : u_pixel_scale; }

vec2 normalized_place(vec3 position) {
    vec4 clip = u_view_projection * vec4(position, 1.0);
    return clip.xy / clip.w;
}

// Where a point behind the surface is seen, relative to this pixel: what is not bent stays in it.
vec2 place_on_picture(vec3 position) {
    vec2 moved = normalized_place(position) - normalized_place(v_position);
    return gl_FragCoord.xy / vec2(textureSize(u_captured, 0)) + 0.5 * moved;
}

vec4 captured_light(vec2 uv, float level) {
    // Beside the picture nothing was drawn: there the environment stands in.
    bool is_beside = any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)));
    return is_beside ? vec4(0.0) : textureLod(u_captured, uv, level);
}

// What stands before the surface is not seen through it; what lies straight behind is.
bool is_before_surface(vec2 uv) {
    ivec2 size = textureSize(u_captured_depth, 0);
    ivec2 corner = ivec2(floor(uv * vec2(size) - 0.5));
    float surface = view_depth(v_position);
    bool is_before = false;
    for (int i = 0; i < 4; ++i) {  // every texel that filtering reads
        vec2 met = texelFetch(u_captured_depth, clamp(corner + ivec2(i & 1, i >> 1), ivec2(0), size - 1), 0).rg;
        is_before = is_before || met.x < surface * met.y;
    }
    return is_before;
}

// A ray that leaves the body, and the lobe around it.
struct Passage {
    vec3 from;
    vec3 direction;
    float roughness;   // perceptual: of a mirror with as wide a lobe
    float spread_rad;  // between neighbouring pixels' directions
};

// Depth of what the lobe meets, from what is known around where it is met.
float depth_behind(Passage passage) {
    float near = view_depth(passage.from);
    float forward = max(dot(u_view_axis.xyz, passage.direction), 1e-3);  // sideways nothing is ever met
    float width = max(2.0 * sq(passage.roughness), passage.spread_rad);
    float depth = near;
    float level = COARSE_LEVEL;
    for (int i = 0; i < 4; ++i) {
        float distance_m = (depth - near) / forward;
        vec2 uv = place_on_picture(passage.from + distance_m * passage.direction);
        vec2 known = textureLod(u_captured_depth, uv, level).rg;
        depth = known.y > 0.0 ? max(known.x / known.y, near) : depth;
        level = log2(max(width * (depth - near) / forward * pixels_per_m(depth), 1.0));
    }
    return depth;
}

// What was drawn farther away, through a lobe of facets that mirror: GGX, seen along its axis.
vec4 captured_lobe(Passage passage) {
    float near = view_depth(passage.from);
    float depth = depth_behind(passage);
    float scale = pixels_per_m(depth);
    float forward = max(dot(u_view_axis.xyz, passage.direction), 1e-3);
    float distance_m = (depth - near) / forward;
    float pixel_width = max(passage.spread_rad * distance_m * scale, 1.0);
    float alpha = sq(passage.roughness);

    if (2.0 * alpha * distance_m * scale < 0.25) {
        vec2 uv = place_on_picture(passage.from + distance_m * passage.direction);
        return is_before_surface(uv) ? texelFetch(u_captured, ivec2(gl_FragCoord.xy), 0)
                                     : captured_light(uv, log2(pixel_width));
    }
    vec3 axis = passage.direction;
    vec3 tangent = normalize(abs(axis.y) < 0.9 ? cross(axis, vec3(0.0, 1.0, 0.0)) : cross(axis, vec3(1.0, 0.0, 0.0)));
    mat3 frame = mat3(tangent, cross(axis, tangent), axis);
    vec4 sum = vec4(0.0);
    float weight = 0.0;
    for (int i = 0; i < LOBE_TAPS; ++i) {
        // Facets follow D cosθ_h; one at θ_h turns light by 2θ_h, with density D/4.
        float share = (float(i) + 0.5) / float(LOBE_TAPS);
        float slope_squared = sq(alpha) * share / (1.0 - share);
        float cos_turn = (1.0 - slope_squared) / (1.0 + slope_squared);
        float sin_turn = 2.0 * sqrt(slope_squared) / (1.0 + slope_squared);
        float azimuth = TAP_TURN * float(i);
        vec3 direction = frame * vec3(sin_turn * vec2(cos(azimuth), sin(azimuth)), cos_turn);
        if (cos_turn > 0.0) {
            weight += cos_turn;
            float along = dot(u_view_axis.xyz, direction);
            if (along > 0.0) {
                float met_m = (depth - near) / along;
                float cos2 = 1.0 / (1.0 + slope_squared);
                float steradians = TAP_OVERLAP * 4.0 * PI * sq(1.0 - cos2 + sq(alpha) * cos2) /
                                   (sq(alpha) * float(LOBE_TAPS));
                float footprint = max(sqrt(steradians) * met_m * scale, pixel_width);
                sum += cos_turn * captured_light(place_on_picture(passage.from + met_m * direction), log2(footprint));
            }
        }
    }
    return sum / weight;
}

// Straight light sees the background as it is drawn, bent light the environment itself.
vec3 behind_scene(Passage passage, bool is_bent) {
    if (!is_bent && u_backdrop.w > 0.0) {
        return u_backdrop.rgb;
    }
#ifdef HAS_IMAGE_LIGHT
    float roughness = is_bent ? passage.roughness : max(passage.roughness, u_background_blur);
    return environment_radiance(passage.direction, roughness, is_bent ? passage.spread_rad : 0.0);
#else
    return vec3(0.0);
#endif
}

vec3 arriving_radiance(vec3 from, vec3 direction, float roughness, bool is_bent) {
    Passage passage = Passage(from, direction, roughness, spread_in_pixel(direction));
    vec4 drawn;
    if (!is_bent && roughness == 0.0) {
        drawn = texelFetch(u_captured, ivec2(gl_FragCoord.xy), 0);
    } else {
        drawn = captured_lobe(passage);
    }
    return drawn.rgb + (1.0 - drawn.a) * behind_scene(passage, is_bent);
}

#ifdef HAS_VOLUME
// How much of a ball the body is here: ½ · thickness · mean curvature of the mesh, from neighbouring pixels.
float roundness_of_body(float thickness_m) {
    vec3 normal = normalize(v_normal);
    vec3 px = dFdx(v_position), py = dFdy(v_position);
    vec3 nx = dFdx(normal), ny = dFdy(normal);
    float xx = dot(px, px), xy = dot(px, py), yy = dot(py, py);
    float area = xx * yy - xy * xy;
    float bent = 0.5 * (yy * dot(nx, px) - xy * (dot(nx, py) + dot(ny, px)) + xx * dot(ny, py));
    // Seen from its edge a surface has no neighbours; seen from inside it is hollow.
    bool is_known = area > 1e-6 * xx * yy && gl_FrontFacing;
    return is_known ? clamp(0.5 * thickness_m * bent / area, 0.0, 1.0) : 0.0;
}

// KHR_materials_volume: bent where it enters and where it leaves, absorbed along the way by Beer's law.
vec3 radiance_through_body(Surface s, vec3 n, vec3 v, float ior) {
    // A mapped normal that turns away from the viewer would bend light back out.
    vec3 facing = normalize(n - min(dot(n, v), 0.0) * v);
    vec3 inside = refract(-v, facing, 1.0 / ior);
    float scale = length(u_world_to_mesh * inside);
    float thickness_m = scale > 0.0 ? s.volume_thickness_m / scale : 0.0;  // 0: the node flattens the mesh
    float roundness = roundness_of_body(thickness_m);
    float cos_theta = max(-dot(facing, inside), 1e-3);  // at index 1 a grazing way through a plate has no end
    float path_m = path_inside(thickness_m, cos_theta, roundness);
    vec3 outside = ior == 1.0 ? -v : refract(inside, -exit_normal(facing, inside, roundness), ior);
    float roughness = refraction_roughness(s.perceptual_roughness, ior);
    vec3 arriving = arriving_radiance(v_position + path_m * inside, outside, roughness, ior != 1.0);
    return exp(-u_volume_absorption_per_m * path_m) * arriving;
}
#endif

// Radiance that a surface which reflects nothing would send to the viewer from behind. v: towards the viewer.
vec3 transmitted_radiance(Surface s, vec3 n, vec3 v) {
#ifdef HAS_VOLUME
#ifdef HAS_DISPERSION
    vec3 ior = dispersed_iors(u_volume_ior, u_dispersion);
    return vec3(radiance_through_body(s, n, v, ior.r).r, radiance_through_body(s, n, v, ior.g).g,
                radiance_through_body(s, n, v, ior.b).b);
#else
    return radiance_through_body(s, n, v, u_volume_ior);
#endif
#else
    return arriving_radiance(v_position, -v, s.perceptual_roughness, false);
#endif
}
