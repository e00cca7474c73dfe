list(APPEND libraries atrium_geometry)
