"""The shapes: ``kind`` defines the interface of a kind of shape, ``kinds`` lists the kinds."""
