"""Reference implementation of KHR_materials_iridescence: evaluator, renderer and spectral truth for glTF."""
