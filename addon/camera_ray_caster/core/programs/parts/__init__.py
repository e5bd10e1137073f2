"""What the programs' files share: documents, their entries, lenses and poses."""
