// Small functions that several phenomena need.

const float PI = 3.14159265358979;

float sq(float x) { return x * x; }
vec3 sq(vec3 x) { return x * x; }

float max3(vec3 v) { return max(v.x, max(v.y, v.z)); }

// x^5; pow(x, 5.0) is undefined for x < 0 and less accurate on some drivers.
float pow5(float x) { return sq(sq(x)) * x; }
