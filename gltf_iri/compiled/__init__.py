"""Compiled twins of the numpy formulas, one scalar loop a phenomenon; importing any of them imports numba.

Nothing imports this folder at a module's top: a function asks for it once `gltf_iri.backends` has chosen it.
"""
