"""Messages of proto/tera/v1/simulation.proto, generated when TERA is built."""
