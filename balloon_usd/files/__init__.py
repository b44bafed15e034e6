"""Files: written whole or not at all, locked while they grow, and known again by their hashes."""
