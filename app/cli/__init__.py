"""The command line: where it starts, the shared flags, and a file for each subcommand."""
