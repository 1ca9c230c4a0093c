"""EXT_materials_bragg: rules, codes, and the stacks that they look at."""
