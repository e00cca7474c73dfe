list(APPEND libraries atrium_floorplan)
