"""The command line: entry point, shared flags, and a file for each subcommand."""
