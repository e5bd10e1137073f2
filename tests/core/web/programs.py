"""The programs of all models, at settings that are spread over their knobs."""

from functools import cache
from itertools import product

import numpy as np

import camera_ray_caster as crc
from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.records import InputError
from camera_ray_caster.core.web.camera_program import with_settings
from camera_ray_caster.core.web.page import example, own_program, page_models

KEYS = [model.key for model in page_models()]
ROUNDS = 4
"""Settings that are tried for each choice."""


@cache
def program(key):
    """The program of a model as the page has it."""
    return own_program(crc.models()[key])


def settings(key):
    """Yield cameras with their settings, all choices and several places of all knobs; not those that are refused."""
    camera_program, raw = program(key), example(crc.models()[key]).record
    generator = np.random.default_rng(7)
    words = {name: {variant.choices[name] for variant in camera_program.variants} for name in camera_program.choices}
    for chosen in product(*map(sorted, words.values())):
        for _ in range(ROUNDS):
            values = {knob.name: float(generator.uniform(knob.low, knob.high)) for knob in camera_program.knobs}
            values = values | dict(zip(words, chosen, strict=True))
            try:
                yield values, camera_from(with_settings(raw, type(camera_program.lens), values))
            except InputError:
                continue
