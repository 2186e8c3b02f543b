"""What assets/scenes/make_scenes.py is made of: one module a scene, and the tools that they share."""
