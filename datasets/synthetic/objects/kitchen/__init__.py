"""Kitchen things: fitted units, appliances, crockery."""
