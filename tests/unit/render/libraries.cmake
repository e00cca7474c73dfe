list(APPEND libraries atrium_synth atrium_geometry)
