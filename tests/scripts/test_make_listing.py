"""The images of the extension's page have the sizes that the site asks for, and are small."""

import pytest

from .running import ROOT

LISTING = ROOT / "listing"


@pytest.mark.parametrize(("name", "size"), [("icon.png", (256, 256)), ("featured.jpg", (1920, 1080))])
def test_icon_and_featured_image_have_the_sizes_of_the_site(blender, name, size):
    image = blender.data.images.load(str(LISTING / name))
    assert tuple(image.size) == size


def test_the_page_names_every_image_and_all_are_small():
    page = (LISTING / "README.md").read_text()
    images = [path for path in LISTING.iterdir() if path.suffix != ".md"]
    assert len(images) >= 5
    assert [path.name for path in images if f"`{path.name}`" not in page] == []
    assert [path.name for path in images if path.stat().st_size > 500_000] == []
