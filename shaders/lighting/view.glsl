// How a point lies to its viewer.

struct View {
    vec3 n;         // shading normal, on the viewer's side
    vec3 v;         // towards the viewer
    float n_dot_v;  // at least N_DOT_V_MIN
#ifdef HAS_ANISOTROPY
    vec3 tangent;   // in the surface, along which highlights are drawn out; 0 where there is no direction
#endif
#ifdef HAS_CLEARCOAT
    vec3 coat_n;    // the coat's own normal
    float coat_n_dot_v;
#endif
};
