"""Ray formulas of any model, recorded and written in other languages: OSL, for cameras in Cycles, and JavaScript."""
