"""The application: command line, pipeline, viewer and files."""
