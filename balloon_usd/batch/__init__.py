"""The batch room: many recipes made side by side."""
