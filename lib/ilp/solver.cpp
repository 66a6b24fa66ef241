// Conflict-driven 0/1 search.
