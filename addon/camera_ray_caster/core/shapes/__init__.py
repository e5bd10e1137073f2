"""The shapes: ``kind`` is the contract, ``kinds`` lists those that there are."""
