"""The `kosaka` model: springs for the rubber and particles for the air (Kosaka 2008)."""
