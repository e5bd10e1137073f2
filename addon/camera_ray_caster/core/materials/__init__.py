"""Materials whose color or alpha changes over a surface: expressions that are evaluated where rays hit."""
