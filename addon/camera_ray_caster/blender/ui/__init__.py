"""Panels and operators."""
