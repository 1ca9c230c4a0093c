"""KHR_materials_iridescence beyond the Khronos checks: rules, codes, and the films that they look at."""
