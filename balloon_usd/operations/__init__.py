"""What balloon twisters do: one operation of the recipe language, one file."""
