find_package(PNG REQUIRED)
list(APPEND libraries atrium_synth atrium_geometry PNG::PNG)
