"""Text forms that programs write: YAML, XML and JSON as entries, also compressed by gzip."""
