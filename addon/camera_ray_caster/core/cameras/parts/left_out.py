"""What a setting is that is left out of a camera made in Python: the values of ``Setting.left_out``."""

DECLARED, SAME, NEEDED, MIDDLE, OF_FRAME = "declared", "same", "needed", "middle", "frame"
"""Values of ``Setting.left_out``. DECLARED: the default, or an error if the partner is given. The others describe a
calibrated picture, of which at least one number is given. SAME: the partner's value, NEEDED if that is left out, too.
NEEDED: an error. MIDDLE: the middle of the picture. OF_FRAME: the frame's side, or an error if the partner is given.
"""
