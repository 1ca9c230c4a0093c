"""Arrays of films in .npy files to arrays of their colours: read, chosen for, and streamed block by block."""
