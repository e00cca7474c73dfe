find_package(PNG REQUIRED)
list(APPEND libraries atrium_floorplan atrium_layout atrium_metric nlohmann_json::nlohmann_json PNG::PNG)
