"""Places to be photographed, one a file, all of them meshes that have few vertices before their modifiers."""
