"""Measurements: this caster beside other ray tracers, other commits and the readers of other programs."""
