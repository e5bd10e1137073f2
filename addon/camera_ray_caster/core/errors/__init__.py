"""How far rounding may have moved rays and hits: forward error bounds."""
