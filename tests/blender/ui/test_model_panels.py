"""What the panels of a camera's model and of its times draw."""


def test_the_panel_shows_what_the_chosen_way_needs(blender):
    from camera_ray_caster.blender.ui.model_panels import TIME, TimePanel

    scene, camera = blender.context.scene, blender.data.cameras.new("Camera")
    own, shown = camera.camera_ray_caster, []

    class Layout:
        """Takes down what is drawn, which has to exist."""

        def prop(self, owner, name):
            assert hasattr(owner, name)
            shown.append(name)

        def template_ID(self, owner, name, open):
            self.prop(owner, name)

    context = type("Context", (), {"camera": camera, "scene": scene})
    assert set(TIME) == {item.identifier for item in own.bl_rna.properties["time_mode"].enum_items}
    for mode, names in TIME.items():
        shown.clear()
        own.time_mode = mode
        TimePanel.draw(type("Panel", (), {"layout": Layout()}), context)
        assert shown == ["time_mode", *(name for name in names if "rolling" not in name or hasattr(scene, "cycles"))]
