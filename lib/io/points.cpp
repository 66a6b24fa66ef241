// Point files.
