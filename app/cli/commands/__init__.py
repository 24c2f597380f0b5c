"""The subcommands, a file each; their imports are delayed until they run."""
