// Cumulative integrals of observer times illuminant over 1/λ, in linear Rec.709: differences weigh a piece of
// a spectrum. Twin: gltf_iri/colour/cumulative.py; evaluation/landmarks.py (`cumulative_table`) fills the table.
// The fourth channel of its first texels holds the parameters of the method that samples it.

uniform highp sampler2D cumulative_colour;

int cumulative_steps() { return textureSize(cumulative_colour, 0).x - 1; }

float cumulative_parameter(int i) { return texelFetch(cumulative_colour, ivec2(i, 0), 0).a; }

// C̄ at `position` steps from 1/830 nm to 1/360 nm, linear between them
// Fourneau et al. 2024, Eq. 16
vec3 cumulative_at(float position) {
    int last = cumulative_steps();
    float inside = clamp(position, 0.0, float(last));
    int at = min(int(inside), last - 1);
    vec3 low = texelFetch(cumulative_colour, ivec2(at, 0), 0).rgb;
    vec3 high = texelFetch(cumulative_colour, ivec2(at + 1, 0), 0).rgb;
    return low + (inside - float(at)) * (high - low);
}
