"""Places to be photographed, one per file, mostly of meshes with few vertices before their modifiers."""
