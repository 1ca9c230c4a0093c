// Fibres over the base: they send light of their own and keep from the base what they take.
// Source: KHR_materials_sheen.

#include "lighting/sheen_albedo.glsl"
#include "lighting/punctual.glsl"
#include "lighting/view.glsl"
#include "optics/sheen.glsl"

// What fibres and base send of one light. The share that reaches the base and comes back is the smaller of the two
// ways'; light from behind meets the fibres on its way out only as the base meets them on its way in.
vec3 sheen_over_punctual(Surface s, View w, Illuminant light, vec3 base) {
    float facing = dot(w.n, light.direction);
    float albedo = max(sheen_albedo(u_sheen_albedo, w.n_dot_v, s.sheen_roughness),
                       sheen_albedo(u_sheen_albedo, clamp(abs(facing), 0.0, 1.0), s.sheen_roughness));
    vec3 sent = base * sheen_weight(s.sheen_color, albedo);
    vec3 halfway = w.v + light.direction;
    if (facing > 0.0 && dot(halfway, halfway) > 0.0) {
        float n_dot_l = min(facing, 1.0);
        float n_dot_h = clamp(dot(w.n, normalize(halfway)), 0.0, 1.0);
        float alpha = sheen_alpha(s.sheen_roughness);
        sent += s.sheen_color * light.illuminance *
                (n_dot_l * d_charlie(n_dot_h, alpha) * v_sheen(n_dot_l, w.n_dot_v, alpha));
    }
    return sent;
}
