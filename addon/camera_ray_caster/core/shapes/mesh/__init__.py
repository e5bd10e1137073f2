"""Triangle meshes: ``meshes`` is their kind of shape; the other files find, bound and follow their triangles."""
