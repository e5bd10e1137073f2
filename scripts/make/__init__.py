"""What makes the example scenes, their pictures, the documentation's pages and the images of the extension's page."""
