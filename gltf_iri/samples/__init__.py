"""The sample assets, built in code: geometry, textures and materials are original and physically meant."""
