"""The `latex` model: a hyperelastic wall and one chamber of gas in each bubble."""
