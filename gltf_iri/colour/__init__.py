"""Observer, colour spaces, colour differences and spectral integration; no glTF, no files of users, no GL."""
