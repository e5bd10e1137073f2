"""The lesson as a page for a browser: any model's rays in JavaScript and GLSL, with its settings as arguments."""
