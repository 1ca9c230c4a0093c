// The film's reflectance as a Fourier series in wavenumber, summed order by order.
// Twin: gltf_iri/optics/film_series.py.

#include "common/math.glsl"
#include "optics/film_admittances.glsl"

// What a polarisation keeps from order to order.
struct FilmSeries {
    vec3 entering;  // G/2
    vec3 ratio;     // z
    vec3 tail;      // H/G
};

// A sum of orders, and the powers 2 · G/2 · z^m of the next one.
struct FilmOrders {
    FilmSeries s;
    FilmSeries p;
    vec3 power_s;
    vec3 power_p;
    vec3 entering;
};

FilmSeries film_series(Admittances y) {
    float first = y.y1 + y.y2;
    float contrast = y.y1 - y.y2;
    vec3 second = y.y2 + y.y3;
    vec3 whole = y.y1 * second * second + contrast * contrast * y.y3;
    // One division for two: software renderers divide slowly.
    vec3 both = 1.0 / (second * whole);
    vec3 inverse = second * both;
    vec3 ratio = (-contrast / first) * (y.y2 - y.y3) * (whole * both);
    vec3 tail = (1.0 + abs(ratio)) * (0.25 / y.y2 * first * first) * (second * second * inverse);
    return FilmSeries(2.0 * y.y1 * y.y2 * y.y3 * inverse, ratio, tail);
}

// Without fringes the series, kept finite, counts nothing, and `without_fringes` stands for what enters the base.
FilmOrders film_orders(FilmAdmittances f, bool has_fringes, vec3 without_fringes) {
    if (!has_fringes) {
        f.s.y2 = 1.0;
        f.p.y2 = 1.0;
    }
    FilmOrders o;
    o.s = film_series(f.s);
    o.p = film_series(f.p);
    o.entering = has_fringes ? o.s.entering + o.p.entering : without_fringes;
    o.power_s = has_fringes ? 2.0 * o.s.entering * o.s.ratio : vec3(0.0);
    o.power_p = has_fringes ? 2.0 * o.p.entering * o.p.ratio : vec3(0.0);
    return o;
}

// Adds an order by its sensitivities, whose fourth is the bound of all that follow; whether the next one counts.
bool add_order(inout FilmOrders o, vec4 sensitivity) {
    vec3 left = abs(o.power_s) * o.s.tail + abs(o.power_p) * o.p.tail;
    o.entering += (o.power_s + o.power_p) * clamp(left * sensitivity.a - 1.0, 0.0, 1.0) * sensitivity.rgb;
    o.power_s *= o.s.ratio;
    o.power_p *= o.p.ratio;
    // The envelope never rises: what this order's leaves below 1 need not be looked up.
    return max3(abs(o.power_s) * o.s.tail + abs(o.power_p) * o.p.tail) * sensitivity.a > 1.0;
}
